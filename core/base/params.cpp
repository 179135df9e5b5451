#include "core/base/params.h"

#include <cmath>

namespace boxwood {

double AreaLimit::max_area(double scene_area) const {
    return absolute ? value : scene_area * std::exp2(-value);
}

}  // namespace boxwood
