#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "core/base/ray.h"
#include "core/scene/mesh.h"

namespace boxwood::bench {

enum class EmbreeQuality : uint8_t { Low, Medium, High };

/// One way to use Embree.
struct EmbreeVariant {
    const char* name;    ///< "embree:high-avx2"
    const char* config;  ///< of its device
    EmbreeQuality quality = EmbreeQuality::High;
    bool robust = false;
    bool by_default = true;  ///< compared where nothing is said about peers
};

/// Those whose rays are compared: of high quality, and of low and medium where they are asked for.
std::span<const EmbreeVariant> embree_variants();
/// Those whose builds are compared: low, medium, high.
std::span<const EmbreeVariant> embree_builds();

/// Whether the program is built with Embree; without it no EmbreeScene can be made.
bool has_embree();
/// "3.13.5"; empty without Embree.
std::string embree_version();

/// A mesh in Embree, and rays through it as its users cast them: one call for each ray, the context's flag
/// incoherent. Answers are those of Embree: of equally near triangles any, and no promise near edges.
/// Primitive numbers are those of the mesh. Moves, does not copy.
class EmbreeScene {
public:
    /// Makes device and geometry. The mesh must outlive this.
    EmbreeScene(const Mesh& mesh, const EmbreeVariant& variant);
    ~EmbreeScene();
    EmbreeScene(EmbreeScene&&) noexcept;
    EmbreeScene& operator=(EmbreeScene&&) noexcept;

    /// Commits the scene, once, before any rays; on as many threads as parallel loops may use (ThreadLimit).
    void build();

    void closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const;
    /// Packets of sixteen rays that follow each other, the context's flag coherent.
    void closest_hits_in_packets(std::span<const Ray> rays, std::span<Hit> hits) const;
    /// occluded[i] = 1 if anything lies on ray i, otherwise 0.
    void any_hits(std::span<const Ray> rays, std::span<uint8_t> occluded) const;

    /// What the device holds, without the mesh's own arrays, which it shares.
    uint64_t byte_count() const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace boxwood::bench
