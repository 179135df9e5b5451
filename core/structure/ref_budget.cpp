#include "core/structure/ref_budget.h"

#include <algorithm>
#include <cmath>

namespace boxwood {

uint32_t default_depth(size_t ref_count) {
    const double levels = 8.0 + 1.3 * std::log2(static_cast<double>(std::max<size_t>(ref_count, 1)));
    return std::min(static_cast<uint32_t>(levels), 64u);
}

}  // namespace boxwood
