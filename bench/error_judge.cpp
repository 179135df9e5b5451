#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "bench/error.h"
#include "bench/error_judge.h"
#include "bench/fast_bound.h"
#include "bench/plain_ray.h"
#include "bench/ratios.h"
#include "core/base/parallel.h"

namespace boxwood::bench {

namespace {

/// Distance from t to the next float.
double unit_in_last_place(float t) {
    const float size = std::abs(t);
    const float next = std::nextafter(size, std::numeric_limits<float>::infinity());
    if (std::isinf(next)) return 0x1p104;
    return static_cast<double>(next) - static_cast<double>(size);
}

/// In units in the last place of `rounded`.
double error_of(float t, const mpq_class& exact, float rounded) {
    if (!std::isfinite(t)) return std::numeric_limits<double>::infinity();
    const mpq_class difference = static_cast<double>(t) - exact;
    return std::abs(difference.get_d()) / unit_in_last_place(rounded);
}

double percentile(std::vector<double>& values, double share) {
    if (values.empty()) return 0.0;
    const auto place = static_cast<size_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(place));
    return values[place];
}

}  // namespace

SampleJudge::SampleJudge(const Mesh& mesh, std::span<const Ray> rays, size_t stride)
    : mesh_(mesh), stride_(std::max<size_t>(stride, 1)) {
    for (size_t i = 0; i < rays.size(); i += stride_) rays_.push_back(rays[i]);
    expected_ = closest_hits(ScreenedOracle(mesh), rays_);
}

Errors SampleJudge::judge(std::span<const Hit> hits, Precision contestant) const {
    Errors errors;
    errors.sample = rays_.size();
    std::vector<size_t> wrong;  // hit for miss, or miss for hit
    std::vector<double> t_errors, t_bounds;
    for (size_t i = 0; i < rays_.size(); ++i) {
        const Hit& found = hits[i * stride_];
        const auto& expected = expected_[i];
        if (found.is_hit() != expected.has_value()) {
            wrong.push_back(i);
        } else if (expected && found.prim != expected->prim) {
            ++errors.wrong_prims;
        } else if (expected) {
            const float rounded = oracle::round_to_float(expected->t);
            t_errors.push_back(error_of(found.t, expected->t, rounded));
            if (contestant == Precision::Exact &&
                std::bit_cast<uint32_t>(found.t) != std::bit_cast<uint32_t>(rounded))
                ++errors.wrong_t;
            if (contestant != Precision::Fast) continue;
            t_bounds.push_back(fast_t_bound(rays_[i], mesh_.triangle(found.prim)) /
                               unit_in_last_place(rounded));
            if (t_errors.back() > t_bounds.back()) ++errors.beyond_bound;
        }
    }
    std::vector<uint8_t> plain(wrong.size());
    parallel_for(wrong.size(), 1, [&](size_t k, size_t) {
        const size_t i = wrong[k];
        const float t = expected_[i] ? oracle::round_to_float(expected_[i]->t) : hits[i * stride_].t;
        plain[k] = is_plain(mesh_, rays_[i], t) ? 1 : 0;
    });
    errors.wrong_plain = static_cast<uint64_t>(std::ranges::count(plain, uint8_t{1}));
    errors.wrong_sensitive = wrong.size() - errors.wrong_plain;
    errors.t_error_p99 = percentile(t_errors, 0.99);
    errors.t_error = percentile(t_errors, 1.0);
    errors.t_bound_p99 = contestant == Precision::Exact ? 0.5 : kNan;
    errors.t_bound = errors.t_bound_p99;
    if (contestant == Precision::Fast) {
        errors.t_bound_p99 = percentile(t_bounds, 0.99);
        errors.t_bound = percentile(t_bounds, 1.0);
    }
    return errors;
}

}  // namespace boxwood::bench
