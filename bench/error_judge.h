#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/error.h"
#include "bench/screened_oracle.h"

namespace boxwood::bench {

/// What rational arithmetic says about every `stride`-th ray, found out once for all that are compared with
/// it.
class SampleJudge {
public:
    SampleJudge(const Mesh& mesh, std::span<const Ray> rays, size_t stride);

    /// hits[i] is the contestant's answer for ray i, all rays counted.
    Errors judge(std::span<const Hit> hits, Precision contestant) const;

private:
    const Mesh& mesh_;
    size_t stride_;
    std::vector<Ray> rays_;  ///< the sample
    std::vector<std::optional<oracle::ExactHit>> expected_;
};

}  // namespace boxwood::bench
