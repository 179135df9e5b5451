#include "bench/stress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <mutex>

#include "bench/plain_ray.h"
#include "bench/stress_cases.h"
#include "core/base/parallel.h"
#include "core/base/timer.h"
#include "oracle/oracle.h"

namespace boxwood::bench {

namespace {

std::string hex_ray(const Ray& ray) {
    char text[256];
    const auto d = [](float value) { return static_cast<double>(value); };
    std::snprintf(text, sizeof text, "%a %a %a %a %a %a %a %a", d(ray.origin.x), d(ray.origin.y),
                  d(ray.origin.z), d(ray.direction.x), d(ray.direction.y), d(ray.direction.z), d(ray.t_min),
                  d(ray.t_max));
    return text;
}

std::string describe(const Hit& hit) {
    char text[64];
    if (!hit.is_hit()) return "a miss";
    std::snprintf(text, sizeof text, "primitive %u at t = %a", hit.prim, static_cast<double>(hit.t));
    return text;
}

struct Judgement {
    const StressKind& kind;
    const Mesh& mesh;
    StressRow& row;
    std::string recipe;
    uint64_t seed;

    void fail(uint64_t& counter, const Ray& ray, const Hit& found, const std::string& expected) const {
        ++counter;
        if (row.mode == Mode::Fast && &counter != &row.wrong_hits) return;
        if (row.first_failure.empty()) {
            row.first_failure = recipe + ", " + kind.name + ", seed " + std::to_string(seed) + ": ray " +
                                hex_ray(ray) + ": found " + describe(found) + ", expected " + expected;
            row.failure = StressFailure{recipe, kind.name, row.mode, kind.make, seed, kind.ray_count, ray};
        }
    }

    void judge(const Ray& ray, const Hit& found) const {
        if (kind.judge == Judge::MustHit) {
            if (!found.is_hit()) fail(row.leaks, ray, found, "a hit of the closed mesh");
            return;
        }
        if (kind.judge == Judge::MustMiss) {
            if (found.is_hit()) fail(row.wrong_hits, ray, found, "a miss");
            return;
        }
        Hit expected;
        if (const std::optional<oracle::ExactHit> exact = oracle::closest_hit(mesh, ray)) {
            expected = {oracle::round_to_float(exact->t), exact->prim};
        }
        if (found == expected) return;
        const bool is_exact = row.mode == Mode::Exact;
        if (found.is_hit() != expected.is_hit()) {
            const bool counts = is_exact || is_plain(mesh, ray, std::min(found.t, expected.t));
            fail(counts ? row.wrong_hits : row.wrong_sensitive, ray, found, describe(expected));
            return;
        }
        const bool is_close = std::abs(found.t - expected.t) <= 0x1p-18f * expected.t;
        if (is_exact ? found.t != expected.t : !is_close) {
            fail(row.wrong_t, ray, found, describe(expected));
        } else if (is_exact && found.prim != expected.prim) {
            fail(row.wrong_prims, ray, found, describe(expected));
        }
    }
};

/// The same triangles, each in the place of another one: a frame before, as far from this one as can be.
Mesh another_frame(Mesh mesh) {
    std::ranges::reverse(mesh.triangles);
    return mesh;
}

/// The structure after the builder and the first `count` transforms.
Structure build(const Recipe& recipe, const Mesh& mesh, size_t count, Task& task) {
    const References references = recipe.references.method().make(mesh, task);
    if (count == 0) return recipe.builder.method().build(mesh, references.refs, task);
    const StageMethod& transform = recipe.transforms[count - 1].method();
    const Structure input =
        build(recipe, transform.input_frame() ? another_frame(mesh) : mesh, count - 1, task);
    return transform.apply(mesh, references.refs, input, task);
}

/// One case: built, traced, judged, added to the row.
void run_case(const StressSettings& settings, const Recipe& recipe, const StressKind& kind, uint64_t seed,
              StressRow& row, Task& task) {
    const StressCase test = kind.make(seed, kind.ray_count);
    const Structure structure = build(recipe, test.mesh, recipe.transforms.size(), task);
    std::vector<Hit> hits(test.rays.size());
    std::vector<Count> counts(test.rays.size());
    structure.closest_hits_counted(test.mesh, test.rays, hits, counts, row.mode, task);
    if (task.stopped()) return;
    if (settings.tamper) settings.tamper(hits);
    const Judgement judgement{kind, test.mesh, row, print(recipe), seed};
    for (size_t i = 0; i < hits.size(); ++i) judgement.judge(test.rays[i], hits[i]);
    for (const Count& count : counts) row.exact_decisions += count.exact;
    row.rays += hits.size();
    ++row.cases;
}

void merge(StressRow& total, const StressRow& part) {
    total.cases += part.cases;
    total.rays += part.rays;
    total.leaks += part.leaks;
    total.wrong_hits += part.wrong_hits;
    total.wrong_sensitive += part.wrong_sensitive;
    total.wrong_prims += part.wrong_prims;
    total.wrong_t += part.wrong_t;
    total.exact_decisions += part.exact_decisions;
    if (total.first_failure.empty()) {
        total.first_failure = part.first_failure;
        total.failure = part.failure;
    }
}

/// Rounds of one case on each thread until the kind's share of time is used and its rays are cast.
StressRow run_kind(const StressSettings& settings, const Recipe& recipe, const StressKind& kind, Mode mode,
                   double seconds, uint64_t least_rays, Task& task) {
    StressRow row;
    row.recipe = print(recipe);
    row.kind = kind.name;
    row.mode = mode;
    const Timer timer;
    const auto thread_number = static_cast<size_t>(thread_count());
    while (row.cases == 0 || timer.milliseconds() < 1000.0 * seconds || row.rays < least_rays) {
        if (task.stopped()) break;
        std::vector<StressRow> parts(thread_number);
        parallel_for(thread_number, 1, [&](size_t begin, size_t) {
            parts[begin].mode = mode;
            run_case(settings, recipe, kind, settings.seed + row.cases + begin, parts[begin], task);
        });
        for (const StressRow& part : parts) merge(row, part);
    }
    return row;
}

/// Of the structure that the recipe makes.
std::string family(const Recipe& recipe) {
    const Stage& last = recipe.transforms.empty() ? recipe.builder : recipe.transforms.back();
    return last.entry().output;
}

}  // namespace

std::vector<StressRow> run_stress(const StressSettings& settings, Task& task) {
    std::vector<StressRow> rows;
    const std::span<const StressKind> kinds = stress_kinds();
    task.total = settings.recipes.size() * settings.modes.size() * kinds.size();
    for (const Recipe& recipe : settings.recipes) {
        for (const Mode mode : settings.modes) {
            for (const StressKind& kind : kinds) {
                if (task.stopped()) return rows;
                const bool is_aimed = mode == Mode::Exact && (settings.aimed_family.empty() ||
                                                              family(recipe) == settings.aimed_family);
                const double share = is_aimed ? kind.aimed_share : 0.0;
                const auto least_rays =
                    static_cast<uint64_t>(std::ceil(share * static_cast<double>(settings.aimed_rays)));
                rows.push_back(run_kind(settings, recipe, kind, mode,
                                        settings.seconds / static_cast<double>(kinds.size()), least_rays,
                                        task));
                ++task.done;
            }
        }
    }
    return rows;
}

}  // namespace boxwood::bench
