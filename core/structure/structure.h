#pragma once

#include <concepts>
#include <memory>
#include <span>
#include <typeinfo>
#include <utility>

#include "core/base/ray.h"
#include "core/base/task.h"
#include "core/scene/mesh.h"
#include "core/structure/closest.h"
#include "core/structure/node_list.h"

namespace boxwood {

/// What every structure offers; see STYLE: a plain struct of arrays, no base class. `kFamily` is the word
/// that recipes use to say what fits: "binary BVH".
template <class S>
concept AccelerationStructure = std::movable<S> &&
    requires(const S& s, const Mesh& mesh, ClosestHit<Mode::Exact>& exact, ClosestHit<Mode::Fast>& fast,
             Count& count, NoCount& no_count, NodeVisits& visits) {
    { S::kFamily } -> std::convertible_to<const char*>;
    { s.closest_hit(mesh, exact, count) } -> std::same_as<void>;
    { s.closest_hit(mesh, exact, no_count) } -> std::same_as<void>;
    { s.closest_hit(mesh, fast, count) } -> std::same_as<void>;
    { s.closest_hit(mesh, exact, visits) } -> std::same_as<void>;
    { s.any_hit(mesh, exact, count) } -> std::same_as<bool>;
    { s.list_nodes() } -> std::same_as<NodeList>;
    { s.byte_count() } -> std::same_as<size_t>;
};

/// A structure that answers whole batches of rays by itself, as Structure::closest_hits and any_hits say.
template <class S>
concept TracesBatches = requires(const S& s, const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                                 std::span<uint8_t> occluded, Mode mode, const Task& task) {
    s.closest_hits(mesh, rays, hits, mode, task);
    s.any_hits(mesh, rays, occluded, mode, task);
};

/// A structure that answers coherent rays faster than others, as Structure::closest_hits_coherent says.
template <class S>
concept TracesPackets = requires(const S& s, const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                                 Mode mode, const Task& task) {
    s.closest_hits_coherent(mesh, rays, hits, mode, task);
};

/// A built structure of any kind, immutable; copies share it. Called for batches of rays, never for one in a
/// loop.
class Structure {
public:
    /// Never for Structure itself: checking that constraint for a copy would check it for a copy again.
    template <class S>
    requires(!std::same_as<S, Structure>) && AccelerationStructure<S> explicit Structure(S structure)
        : self_(std::make_shared<Model<S>>(std::move(structure))) {}

    /// Nearest hit of each ray; hits.size() == rays.size(). A ray that is not valid (see is_valid) misses.
    /// Stops when task.stop is requested: what is then written or not is not to be read.
    void closest_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits, Mode mode,
                      const Task& task) const {
        self_->closest_hits(mesh, rays, hits, {}, mode, task);
    }
    /// The same for rays of which every 16 in turn, from the first, are neighbours, best of one origin: those
    /// of a block of 4 x 4 pixels.
    void closest_hits_coherent(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits, Mode mode,
                               const Task& task) const {
        self_->closest_hits_coherent(mesh, rays, hits, mode, task);
    }
    /// The same as closest_hits, counted: counts.size() == rays.size(), each entry overwritten. Never timed.
    void closest_hits_counted(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                              std::span<Count> counts, Mode mode, const Task& task) const {
        self_->closest_hits(mesh, rays, hits, counts, mode, task);
    }
    /// occluded[i] = 1 if anything lies on ray i, otherwise 0.
    void any_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<uint8_t> occluded, Mode mode,
                  const Task& task) const {
        self_->any_hits(mesh, rays, occluded, mode, task);
    }
    /// Adds to visits[n], for each ray, how often its closest hit visits node n of list_nodes().
    void add_visits(const Mesh& mesh, std::span<const Ray> rays, std::span<uint32_t> visits, Mode mode,
                    const Task& task) const {
        self_->add_visits(mesh, rays, visits, mode, task);
    }
    /// Parents before children; node n is the one that NodeVisits counts under n.
    NodeList list_nodes() const { return self_->list_nodes(); }
    size_t byte_count() const { return self_->byte_count(); }
    const char* family() const { return self_->family(); }

    /// The concrete structure, or nullptr if it is another type.
    template <AccelerationStructure S>
    const S* as() const {
        const auto* model = dynamic_cast<const Model<S>*>(self_.get());
        return model ? &model->structure : nullptr;
    }

private:
    struct Interface {
        virtual ~Interface() = default;
        virtual void closest_hits(const Mesh&, std::span<const Ray>, std::span<Hit>, std::span<Count>, Mode,
                                  const Task&) const = 0;
        virtual void closest_hits_coherent(const Mesh&, std::span<const Ray>, std::span<Hit>, Mode,
                                           const Task&) const = 0;
        virtual void any_hits(const Mesh&, std::span<const Ray>, std::span<uint8_t>, Mode,
                              const Task&) const = 0;
        virtual void add_visits(const Mesh&, std::span<const Ray>, std::span<uint32_t>, Mode,
                                const Task&) const = 0;
        virtual NodeList list_nodes() const = 0;
        virtual size_t byte_count() const = 0;
        virtual const char* family() const = 0;
    };

    template <class S>
    struct Model final : Interface {
        explicit Model(S s) : structure(std::move(s)) {}

        template <Mode mode>
        void closest_hits_in(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                             std::span<Count> counts, const Task& task) const {
            for (size_t i = 0; i < rays.size() && !task.stopped(); ++i) {
                hits[i] = Hit{};
                if (!counts.empty()) counts[i] = Count{};
                if (!is_valid(rays[i])) continue;
                ClosestHit<mode> closest(rays[i]);
                closest.watch(task);
                if (counts.empty()) {
                    NoCount no_count;
                    structure.closest_hit(mesh, closest, no_count);
                } else {
                    structure.closest_hit(mesh, closest, counts[i]);
                }
                hits[i] = closest.hit(mesh);
            }
        }
        template <Mode mode>
        void any_hits_in(const Mesh& mesh, std::span<const Ray> rays, std::span<uint8_t> occluded,
                         const Task& task) const {
            for (size_t i = 0; i < rays.size() && !task.stopped(); ++i) {
                occluded[i] = 0;
                if (!is_valid(rays[i])) continue;
                ClosestHit<mode> closest(rays[i]);
                closest.watch(task);
                NoCount no_count;
                occluded[i] = structure.any_hit(mesh, closest, no_count) ? 1 : 0;
            }
        }
        void closest_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                          std::span<Count> counts, Mode mode, const Task& task) const override {
            if constexpr (TracesBatches<S>) {
                if (counts.empty()) return structure.closest_hits(mesh, rays, hits, mode, task);
            }
            if (mode == Mode::Exact) {
                closest_hits_in<Mode::Exact>(mesh, rays, hits, counts, task);
            } else {
                closest_hits_in<Mode::Fast>(mesh, rays, hits, counts, task);
            }
        }
        void closest_hits_coherent(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                                   Mode mode, const Task& task) const override {
            if constexpr (TracesPackets<S>) {
                structure.closest_hits_coherent(mesh, rays, hits, mode, task);
            } else {
                closest_hits(mesh, rays, hits, {}, mode, task);
            }
        }
        void any_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<uint8_t> occluded, Mode mode,
                      const Task& task) const override {
            if constexpr (TracesBatches<S>) {
                structure.any_hits(mesh, rays, occluded, mode, task);
            } else if (mode == Mode::Exact) {
                any_hits_in<Mode::Exact>(mesh, rays, occluded, task);
            } else {
                any_hits_in<Mode::Fast>(mesh, rays, occluded, task);
            }
        }
        template <Mode mode>
        void add_visits_in(const Mesh& mesh, std::span<const Ray> rays, NodeVisits visits,
                           const Task& task) const {
            for (size_t i = 0; i < rays.size() && !task.stopped(); ++i) {
                if (!is_valid(rays[i])) continue;
                ClosestHit<mode> closest(rays[i]);
                closest.watch(task);
                structure.closest_hit(mesh, closest, visits);
            }
        }
        void add_visits(const Mesh& mesh, std::span<const Ray> rays, std::span<uint32_t> visits, Mode mode,
                        const Task& task) const override {
            if (mode == Mode::Exact) {
                add_visits_in<Mode::Exact>(mesh, rays, {visits}, task);
            } else {
                add_visits_in<Mode::Fast>(mesh, rays, {visits}, task);
            }
        }
        NodeList list_nodes() const override { return structure.list_nodes(); }
        size_t byte_count() const override { return structure.byte_count(); }
        const char* family() const override { return S::kFamily; }

        S structure;
    };

    std::shared_ptr<const Interface> self_;
};

}  // namespace boxwood
