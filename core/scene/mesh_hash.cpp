#include "core/scene/mesh_hash.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "core/base/parallel.h"
#include "core/base/rng.h"

namespace boxwood {
namespace {

uint64_t combine(uint64_t hash, uint64_t value) {
    return mix_bits((hash ^ value) + 0x9e3779b97f4a7c15ull) + (hash << 7);
}

uint64_t hash_bytes(std::span<const std::byte> bytes) {
    uint64_t hash = bytes.size();
    for (size_t i = 0; i < bytes.size(); i += sizeof(uint64_t)) {
        uint64_t word = 0;
        std::memcpy(&word, bytes.data() + i, std::min(sizeof(word), bytes.size() - i));
        hash = combine(hash, word);
    }
    return hash;
}

/// In blocks, so that it runs in parallel; the blocks do not depend on the number of threads.
template <class T, class Allocator>
uint64_t hash_array(const std::vector<T, Allocator>& values) {
    static_assert(sizeof(T) % sizeof(uint32_t) == 0 && alignof(T) == alignof(uint32_t), "no padding");
    constexpr size_t kBlock = size_t{1} << 18;
    const std::span<const std::byte> bytes = std::as_bytes(std::span(values));
    std::vector<uint64_t> blocks((bytes.size() + kBlock - 1) / kBlock);
    parallel_for(blocks.size(), 1, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            blocks[i] = hash_bytes(bytes.subspan(i * kBlock, std::min(kBlock, bytes.size() - i * kBlock)));
    });
    return hash_bytes(std::as_bytes(std::span(blocks)));
}

}  // namespace

uint64_t content_hash(const Mesh& mesh) {
    uint64_t hash = hash_array(mesh.positions);
    hash = combine(hash, hash_array(mesh.triangles));
    hash = combine(hash, hash_array(mesh.source_prim));
    hash = combine(hash, hash_array(mesh.object));
    for (const MeshObject& object : mesh.objects) {
        hash = combine(hash, hash_bytes(std::as_bytes(std::span(object.name))));
        hash = combine(hash, hash_array(std::vector<Vec3>{object.base_color}));
    }
    hash = combine(hash, hash_array(mesh.points.positions));
    return combine(hash, hash_array(mesh.points.normals));
}

}  // namespace boxwood
