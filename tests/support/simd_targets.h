#pragma once

#include <hwy/targets.h>

#include <cstdint>
#include <functional>
#include <string>

namespace boxwood {

/// An instruction set that Highway compiles for.
struct SimdTarget {
    int64_t bit;

    std::string name() const { return hwy::TargetName(bit); }
    bool has_vectors() const { return bit != HWY_SCALAR; }
    bool has_fused_operations() const {
#if HWY_ARCH_X86
        return bit <= HWY_AVX2;  // better ones have lower bits
#else
        return has_vectors();
#endif
    }
};

/// Calls f(target) with each instruction set in use that this machine has and `generated` names: HWY_TARGETS
/// of the calling source. (hwy::SupportedAndGeneratedTargets() is an inline function of which the linker
/// keeps one: it may name those of another source.)
inline void for_each_target(int64_t generated, const std::function<void(const SimdTarget&)>& f) {
    for (int64_t rest = hwy::SupportedTargets() & generated; rest != 0; rest &= rest - 1) {
        const SimdTarget target{rest & -rest};
        hwy::SetSupportedTargetsForTest(target.bit);
        f(target);
        hwy::SetSupportedTargetsForTest(0);
    }
}

/// The same for those that have vectors: f(name, whether it has fused operations).
inline void for_each_vector_target(int64_t generated,
                                   const std::function<void(const std::string&, bool)>& f) {
    for_each_target(generated, [&](const SimdTarget& target) {
        if (target.has_vectors()) f(target.name(), target.has_fused_operations());
    });
}

}  // namespace boxwood
