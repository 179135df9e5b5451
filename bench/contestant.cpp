#include "bench/contestant.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "bench/build_time.h"
#include "bench/timing.h"
#include "core/base/assert.h"
#include "core/base/parallel.h"
#include "core/render/pixel_tracer.h"

namespace boxwood::bench {

namespace {

constexpr size_t kBatch = 4096;  ///< rays that a thread takes at once; whole packets
constexpr size_t kPixels = 256;  ///< that the renderer takes at once

void cast_part(const Contestant& contestant, const RaySet& set, size_t begin, size_t end, Answers& answers) {
    const std::span<const Ray> rays = std::span(set.rays).subspan(begin, end - begin);
    if (set.casting == Casting::Any) {
        contestant.any_hits(rays, std::span(answers.occluded).subspan(begin, end - begin));
        return;
    }
    const std::span<Hit> hits = std::span(answers.hits).subspan(begin, end - begin);
    if (set.casting == Casting::Closest) {
        contestant.closest_hits(rays, hits);
    } else {
        contestant.packets(rays, std::span(set.pixels).subspan(begin, end - begin), hits);
    }
}

/// Where there are several builds, one more goes before them, which finds no memory at hand: it is not
/// counted.
template <class BuildOnce>
double median_build_ms(int builds, const BuildOnce& build_once) {
    if (builds > 1) build_once();
    std::vector<double> times;
    for (int i = 0; i < builds; ++i) times.push_back(build_once());
    return median_of(times);
}

Contestant in_mode(Mode mode, const std::string& recipe) {
    Contestant one;
    one.recipe = recipe;
    one.name = "boxwood:" + recipe;
    one.mode = mode == Mode::Exact ? "exact" : "fast";
    one.demand = mode == Mode::Exact ? Demand::Exact : Demand::Nearest;
    return one;
}

Contestant structure_in(Mode mode, const std::string& recipe, const Structure& structure, const Mesh& mesh,
                        const Task& task) {
    Contestant one = in_mode(mode, recipe);
    one.closest_hits = [structure, &mesh, mode, &task](std::span<const Ray> rays, std::span<Hit> hits) {
        structure.closest_hits(mesh, rays, hits, mode, task);
    };
    one.packets = [structure, &mesh, mode, &task](std::span<const Ray> rays,
                                                  std::span<const uint32_t> /*pixels*/, std::span<Hit> hits) {
        structure.closest_hits_coherent(mesh, rays, hits, mode, task);
    };
    one.any_hits = [structure, &mesh, mode, &task](std::span<const Ray> rays, std::span<uint8_t> occluded) {
        structure.any_hits(mesh, rays, occluded, mode, task);
    };
    return one;
}

Contestant renderer_in(Mode mode, const std::string& recipe, const Structure& structure, const Mesh& mesh,
                       const ContestantSettings& settings, const Task& task) {
    TraceSettings picture;
    picture.camera = settings.camera;
    picture.width = settings.size;
    picture.height = settings.size;
    picture.mode = mode;
    const auto tracer = std::make_shared<const PixelTracer>(mesh, mesh.bounds(), structure, picture);
    Contestant one = in_mode(mode, recipe);
    one.name += " renderer";
    one.packets = [tracer, &task](std::span<const Ray> /*same*/, std::span<const uint32_t> pixels,
                                  std::span<Hit> hits) {
        std::vector<Ray> rays;
        for (size_t begin = 0; begin < pixels.size() && !task.stopped(); begin += kPixels) {
            const size_t count = std::min(kPixels, pixels.size() - begin);
            tracer->find_hits(/*sample=*/0, pixels.subspan(begin, count), rays, hits.subspan(begin, count),
                              task);
        }
    };
    return one;
}

}  // namespace

bool Contestant::takes(Casting casting) const {
    if (casting == Casting::Any) return any_hits != nullptr;
    return casting == Casting::Closest ? closest_hits != nullptr : packets != nullptr;
}

std::optional<Structure> add_recipe(std::vector<Contestant>& contestants, const Recipe& recipe,
                                    const Mesh& mesh, const ContestantSettings& settings, Task& task) {
    std::optional<TimedBuild> built;
    const double build_ms = median_build_ms(settings.builds, [&] {
        built.reset();
        if (!task.stopped()) built = build_timed(recipe, mesh, settings.threads, task);
        return built ? built->ms() : 0.0;
    });
    if (!built) return std::nullopt;
    const std::string text = print(recipe);
    for (const Mode mode : {Mode::Exact, Mode::Fast}) {
        if (mode == Mode::Fast && !settings.with_fast_mode) continue;
        std::array both{structure_in(mode, text, built->structure, mesh, task),
                        renderer_in(mode, text, built->structure, mesh, settings, task)};
        for (Contestant& one : both) {
            one.build_ms = build_ms;
            one.bytes = built->structure.byte_count();
            contestants.push_back(std::move(one));
        }
    }
    return built->structure;
}

void add_embree(std::vector<Contestant>& contestants, const EmbreeVariant& variant, const Mesh& mesh,
                const ContestantSettings& settings) {
    const ThreadLimit limit(settings.threads);
    std::shared_ptr<EmbreeScene> scene;
    const double build_ms = median_build_ms(settings.builds, [&] {
        scene.reset();
        scene = std::make_shared<EmbreeScene>(mesh, variant);
        const double begin = clock_ms(settings.threads);
        scene->build();
        return clock_ms(settings.threads) - begin;
    });
    Contestant one;
    one.name = variant.name;
    one.closest_hits = [scene](std::span<const Ray> rays, std::span<Hit> hits) {
        scene->closest_hits(rays, hits);
    };
    one.any_hits = [scene](std::span<const Ray> rays, std::span<uint8_t> occluded) {
        scene->any_hits(rays, occluded);
    };
    one.packets = [scene](std::span<const Ray> rays, std::span<const uint32_t> /*pixels*/,
                          std::span<Hit> hits) { scene->closest_hits_in_packets(rays, hits); };
    one.build_ms = build_ms;
    one.bytes = scene->byte_count();
    contestants.push_back(std::move(one));
}

double cast(const Contestant& contestant, const RaySet& set, int threads, Answers& answers) {
    BOXWOOD_ASSERT(!flushes_to_zero());
    const double begin = clock_ms(threads);
    if (threads == 1) {
        cast_part(contestant, set, 0, set.rays.size(), answers);
    } else {
        parallel_for(set.rays.size(), kBatch,
                     [&](size_t first, size_t end) { cast_part(contestant, set, first, end, answers); });
    }
    return clock_ms(threads) - begin;
}

}  // namespace boxwood::bench
