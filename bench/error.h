#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/task.h"
#include "core/catalog/pipeline.h"
#include "core/measure/report.h"
#include "core/scene/camera.h"

namespace boxwood::bench {

/// Who casts the rays: the two modes, and plain double precision over the same boxes (DoubleTracer).
enum class Precision : uint8_t { Exact, Fast, Double };

inline constexpr const char* kContestantNames[] = {"exact", "fast", "double"};

struct ErrorSettings {
    std::vector<Recipe> recipes;
    Camera camera;
    size_t ray_count = 100000;   ///< of each kind: primary, diffuse
    size_t sample_count = 2000;  ///< of them judged by rational arithmetic, evenly spread
    double seconds = 5.0;        ///< at least, for the timed rounds of each kind of rays; 0: not timed
    uint64_t least_rounds = 7;
    uint64_t seed = 1;  ///< of the order within rounds
};

/// Answers compared with rational arithmetic. A wrong answer: a hit for a miss or a miss for a hit, counted
/// apart for plain and sensitive rays (is_plain); another primitive than the nearest; in exact mode also
/// another t than the exact one rounded once.
struct Errors {
    uint64_t sample = 0;
    uint64_t wrong_plain = 0;
    uint64_t wrong_sensitive = 0;
    uint64_t wrong_prims = 0;
    uint64_t wrong_t = 0;
    uint64_t beyond_bound = 0;  ///< fast mode: t of the right primitive is off by more than fast_t_bound
    /// Of the right primitive's t, in units in the last place of the exact t rounded to float.
    double t_error = 0.0, t_error_p99 = 0.0;
    double t_bound = 0.0, t_bound_p99 = 0.0;  ///< what is promised; NaN where nothing is

    uint64_t wrong() const { return wrong_plain + wrong_sensitive + wrong_prims + wrong_t; }
};

/// Times of the rounds of one contestant. A time counts only if the answers of its round are the recorded
/// ones.
struct Rounds {
    uint64_t recorded_hash = 0;
    std::vector<double> ms;
    uint64_t refused = 0;

    void add(double round_ms, uint64_t hash);
    double median() const;  ///< NaN where there is none, also below
    double least() const;
    double greatest() const;
};

/// One recipe, one kind of rays, one contestant.
struct ErrorRow {
    std::string scene, recipe, rays_kind;
    Precision contestant = Precision::Exact;
    uint64_t triangles = 0, references = 0, bytes = 0;
    double build_ms = 0.0;
    uint64_t rays = 0, rays_hash = 0;
    Count count;  ///< of all rays, from the pass that is not timed
    Errors errors;
    Rounds rounds;
    double over_fast = 0.0;  ///< median over the rounds of its time / fast mode's; NaN where not timed

    /// No answer of a timed round changed. Exact mode: none is wrong. Fast mode: hits and misses of plain
    /// rays are right, and every t is within its bound.
    bool holds() const;
};

/// Rows in the order of rays, recipes, contestants. First each contestant casts all rays counted, and a
/// sample of its answers is judged; then the timed rounds: each casts all rays of all contestants in random
/// order, after one round that only warms up. One thread; the time is that of the process, so that a busy
/// machine counts less. After a stop not to be used.
std::vector<ErrorRow> run_error(std::shared_ptr<const Scene> scene, const ErrorSettings& settings,
                                Task& task);

/// With the keys of the design.
ReportRow report_row(const ErrorRow& row);

}  // namespace boxwood::bench
