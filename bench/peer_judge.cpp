#include "bench/peer_judge.h"

#include <algorithm>
#include <bit>

#include "bench/picture_check.h"
#include "bench/ray_sets.h"

namespace boxwood::bench {

namespace {

constexpr size_t kDisputedPerSample = 10;

/// Whether the two answer ray i by different primitives, or differ on whether it is occluded.
bool differ(const Answers& a, const Answers& b, size_t i) {
    if (!a.occluded.empty()) return a.occluded[i] != b.occluded[i];
    return a.hits[i].prim != b.hits[i].prim;
}

bool is_at(const Mesh& mesh, const Ray& ray, uint32_t prim, const mpq_class& t) {
    const std::optional<mpq_class> own = oracle::intersect(ray, mesh.triangle(prim));
    return own && *own == t;
}

void judge(const Mesh& mesh, const Ray& ray, const std::optional<oracle::ExactHit>& expected,
           const Hit& found, Demand demand, PeerErrors& errors) {
    if (found.is_hit() != expected.has_value()) {
        ++errors.wrong_hits;
    } else if (!expected) {
        return;
    } else if (found.prim != expected->prim) {
        const bool is_tie = demand == Demand::Nearest && is_at(mesh, ray, found.prim, expected->t);
        ++(is_tie ? errors.ties : errors.wrong_prims);
    } else if (demand == Demand::Exact && std::bit_cast<uint32_t>(found.t) !=
                                              std::bit_cast<uint32_t>(oracle::round_to_float(expected->t))) {
        ++errors.wrong_t;
    }
}

}  // namespace

void Answers::resize_for(const RaySet& set) {
    hits.resize(set.casting == Casting::Any ? 0 : set.rays.size());
    occluded.resize(set.casting == Casting::Any ? set.rays.size() : 0);
}

uint64_t Answers::hash() const {
    return occluded.empty() ? hash_of(std::span<const Hit>(hits))
                            : hash_of(std::span<const uint8_t>(occluded));
}

std::vector<uint32_t> rays_to_judge(std::span<const Answers> answers, size_t ray_count, size_t sample_count,
                                    uint64_t& disputed_count) {
    std::vector<uint32_t> disputed;
    for (size_t i = 0; i < ray_count; ++i) {
        const bool is_disputed = std::ranges::any_of(
            answers, [&](const Answers& other) { return differ(answers.front(), other, i); });
        if (is_disputed) disputed.push_back(static_cast<uint32_t>(i));
    }
    disputed_count = disputed.size();
    std::vector<uint32_t> judged = even_sample(ray_count, sample_count);
    for (const uint32_t k : even_sample(disputed.size(), kDisputedPerSample * sample_count))
        judged.push_back(disputed[k]);
    std::ranges::sort(judged);
    judged.erase(std::unique(judged.begin(), judged.end()), judged.end());
    return judged;
}

std::vector<PeerErrors> judge_answers(const Mesh& mesh, const ScreenedOracle& oracle, const RaySet& set,
                                      std::span<const uint32_t> judged, std::span<const Answers> answers,
                                      std::span<const Demand> demands) {
    std::vector<Ray> rays;
    for (const uint32_t i : judged) rays.push_back(set.rays[i]);
    const std::vector<std::optional<oracle::ExactHit>> expected = closest_hits(oracle, rays);
    std::vector<PeerErrors> all(answers.size());
    for (size_t a = 0; a < answers.size(); ++a) {
        all[a].judged = judged.size();
        for (size_t k = 0; k < judged.size(); ++k) {
            const uint32_t i = judged[k];
            if (set.casting == Casting::Any) {
                all[a].wrong_hits += (answers[a].occluded[i] != 0) != expected[k].has_value() ? 1 : 0;
            } else {
                judge(mesh, rays[k], expected[k], answers[a].hits[i], demands[a], all[a]);
            }
        }
    }
    return all;
}

}  // namespace boxwood::bench
