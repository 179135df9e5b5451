#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/stress_cases.h"
#include "core/base/ray.h"
#include "core/base/task.h"
#include "core/catalog/recipe.h"

namespace boxwood::bench {

struct StressSettings {
    std::vector<Recipe> recipes;
    std::vector<Mode> modes{Mode::Exact, Mode::Fast};
    double seconds = 3.0;  ///< for each recipe and mode, shared by the kinds; every kind is run once at least
    /// At least so many rays on closed meshes in exact mode, whatever it takes, for each recipe that makes a
    /// structure of `aimed_family`; empty: for each recipe.
    uint64_t aimed_rays = 0;
    std::string aimed_family;
    uint64_t seed = 1;
    std::function<void(std::span<Hit>)> tamper;  ///< for tests: changes the answers before they are judged
};

/// A ray with a wrong answer and how to make its case again: make(seed, ray_count).
struct StressFailure {
    std::string recipe;
    std::string kind;
    Mode mode = Mode::Exact;
    StressCase (*make)(uint64_t seed, size_t ray_count) = nullptr;
    uint64_t seed = 0;
    size_t ray_count = 0;
    Ray ray;
};

/// What one recipe did on one kind of case in one mode.
struct StressRow {
    std::string recipe;
    std::string kind;
    Mode mode = Mode::Exact;
    uint64_t cases = 0;
    uint64_t rays = 0;
    uint64_t leaks = 0;            ///< a closed mesh missed from inside
    uint64_t wrong_hits = 0;       ///< hit for miss or miss for hit, on plain rays in fast mode
    uint64_t wrong_sensitive = 0;  ///< fast mode: the same on rays near an edge or an end of the range
    uint64_t wrong_prims =
        0;  ///< another primitive than the nearest (fast mode: at the same t within rounding is right)
    uint64_t wrong_t = 0;          ///< t is not the exact one, rounded (fast mode: off by more than 2^-18)
    uint64_t exact_decisions = 0;  ///< left to exact arithmetic
    std::string
        first_failure;  ///< recipe, kind and seed, the ray in hex, what was found and what was expected

    std::optional<StressFailure> failure;  ///< the same, to be saved

    /// Exact mode: no wrong answer of any kind. Fast mode: no wrong hit or miss on plain rays.
    bool holds() const {
        return wrong_hits == 0 && (mode == Mode::Fast || (leaks == 0 && wrong_prims == 0 && wrong_t == 0));
    }
};

/// The numerical suite: every recipe in every mode on every kind of stress_kinds(), judged by rational
/// arithmetic or by construction. Rows in the order of the recipes, modes and kinds. Stops early with what
/// was reached if task.stop is requested.
std::vector<StressRow> run_stress(const StressSettings& settings, Task& task);

}  // namespace boxwood::bench
