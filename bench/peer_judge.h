#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "bench/screened_oracle.h"
#include "core/base/ray.h"

namespace boxwood::bench {

/// How the rays of a set are cast.
enum class Casting : uint8_t {
    Closest,  ///< nearest hits
    Any,      ///< whether anything is hit
    Packets,  ///< nearest hits, neighbours together by those who can
};

/// The same rays for all.
struct RaySet {
    std::string kind;  ///< "diffuse"
    Casting casting = Casting::Closest;
    std::vector<Ray> rays;
    std::vector<uint32_t> pixels{};  ///< Packets: y * width + x of each ray
};

/// One contestant's answers; of the two lists the one that the set's casting asks for, the other is empty.
struct Answers {
    std::vector<Hit> hits;
    std::vector<uint8_t> occluded;

    void resize_for(const RaySet& set);
    uint64_t hash() const;
};

/// Answers compared with rational arithmetic.
struct PeerErrors {
    uint64_t judged = 0;      ///< rays
    uint64_t wrong_hits = 0;  ///< a hit for a miss, or a miss for a hit
    uint64_t wrong_prims =
        0;                 ///< a primitive that is not nearest; where ties count, another than the first one
    uint64_t wrong_t = 0;  ///< only where bits count: t is not the exact one rounded once
    uint64_t ties = 0;     ///< another one of several nearest primitives, where that does not count as wrong

    uint64_t wrong() const { return wrong_hits + wrong_prims + wrong_t; }
};

/// What is demanded of a contestant's answers.
enum class Demand : uint8_t {
    Nearest,  ///< a primitive at the smallest exact t
    Exact,    ///< the lowest of those, and t rounded once
};

/// Which rays of the set are judged: `sample_count` of them evenly spread, and where contestants disagree, as
/// one of them has to be wrong or there is a tie, up to ten times as many. Ascending.
std::vector<uint32_t> rays_to_judge(std::span<const Answers> answers, size_t ray_count, size_t sample_count,
                                    uint64_t& disputed_count);

/// By exact arithmetic, on all threads; demands.size() == answers.size() == the result's.
std::vector<PeerErrors> judge_answers(const Mesh& mesh, const ScreenedOracle& oracle, const RaySet& set,
                                      std::span<const uint32_t> judged, std::span<const Answers> answers,
                                      std::span<const Demand> demands);

}  // namespace boxwood::bench
