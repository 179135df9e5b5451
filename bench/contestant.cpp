#include "bench/contestant.h"

#include <memory>
#include <utility>

#include "bench/build_time.h"
#include "bench/timing.h"
#include "core/base/assert.h"
#include "core/base/parallel.h"

namespace boxwood::bench {

namespace {

constexpr size_t kBatch = 4096;  ///< rays that a thread takes at once; whole packets

void cast_part(const Contestant& contestant, const RaySet& set, size_t begin, size_t end, Answers& answers) {
    const std::span<const Ray> rays = std::span(set.rays).subspan(begin, end - begin);
    if (set.casting == Casting::Any) {
        contestant.any_hits(rays, std::span(answers.occluded).subspan(begin, end - begin));
    } else {
        const auto& closest = set.casting == Casting::Packets ? contestant.packets : contestant.closest_hits;
        closest(rays, std::span(answers.hits).subspan(begin, end - begin));
    }
}

}  // namespace

bool Contestant::takes(Casting casting) const {
    if (casting == Casting::Any) return any_hits != nullptr;
    return casting == Casting::Closest ? closest_hits != nullptr : packets != nullptr;
}

std::optional<Structure> add_recipe(std::vector<Contestant>& contestants, const Recipe& recipe,
                                    const Mesh& mesh, int threads, int builds, bool with_fast_mode,
                                    Task& task) {
    std::vector<double> times;
    std::optional<TimedBuild> built;
    for (int i = 0; i < builds; ++i) {
        built.reset();
        built = build_timed(recipe, mesh, threads, task);
        if (!built) return std::nullopt;
        times.push_back(built->ms());
    }
    for (const Mode mode : {Mode::Exact, Mode::Fast}) {
        if (mode == Mode::Fast && !with_fast_mode) continue;
        Contestant one;
        one.recipe = print(recipe);
        one.name = "boxwood:" + one.recipe;
        one.mode = mode == Mode::Exact ? "exact" : "fast";
        one.demand = mode == Mode::Exact ? Demand::Exact : Demand::Nearest;
        one.closest_hits = [structure = built->structure, &mesh, mode, &task](std::span<const Ray> rays,
                                                                              std::span<Hit> hits) {
            structure.closest_hits(mesh, rays, hits, mode, task);
        };
        one.packets = one.closest_hits;
        one.any_hits = [structure = built->structure, &mesh, mode, &task](std::span<const Ray> rays,
                                                                          std::span<uint8_t> occluded) {
            structure.any_hits(mesh, rays, occluded, mode, task);
        };
        one.build_ms = median_of(times);
        one.bytes = built->structure.byte_count();
        contestants.push_back(std::move(one));
    }
    return built->structure;
}

void add_embree(std::vector<Contestant>& contestants, const EmbreeVariant& variant, const Mesh& mesh,
                int threads, int builds) {
    const ThreadLimit limit(threads);
    std::vector<double> times;
    std::shared_ptr<EmbreeScene> scene;
    for (int i = 0; i < builds; ++i) {
        scene.reset();
        scene = std::make_shared<EmbreeScene>(mesh, variant);
        const double begin = clock_ms(threads);
        scene->build();
        times.push_back(clock_ms(threads) - begin);
    }
    Contestant one;
    one.name = variant.name;
    one.closest_hits = [scene](std::span<const Ray> rays, std::span<Hit> hits) {
        scene->closest_hits(rays, hits);
    };
    one.any_hits = [scene](std::span<const Ray> rays, std::span<uint8_t> occluded) {
        scene->any_hits(rays, occluded);
    };
    one.packets = [scene](std::span<const Ray> rays, std::span<Hit> hits) {
        scene->closest_hits_in_packets(rays, hits);
    };
    one.build_ms = median_of(times);
    one.bytes = scene->byte_count();
    contestants.push_back(std::move(one));
}

double cast(const Contestant& contestant, const RaySet& set, int threads, Answers& answers) {
    BOXWOOD_ASSERT(!flushes_to_zero());
    if (threads == 1) {
        const CorePin pin;
        const double begin = clock_ms(threads);
        cast_part(contestant, set, 0, set.rays.size(), answers);
        return clock_ms(threads) - begin;
    }
    const double begin = clock_ms(threads);
    parallel_for(set.rays.size(), kBatch,
                 [&](size_t first, size_t end) { cast_part(contestant, set, first, end, answers); });
    return clock_ms(threads) - begin;
}

}  // namespace boxwood::bench
