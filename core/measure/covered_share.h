#pragma once

#include <span>

#include "core/base/box.h"

namespace boxwood {

/// The share of `box` that the union of `parts` covers, 0 to 1: of its volume, of its area where it is flat
/// in one axis, of its length where in two; 1 for a point that a part covers. What sticks out of the box does
/// not count. 0 for an empty box. Time grows with the cube of the number of parts where all overlap, little
/// more than linearly where few do.
double covered_share(const Box& box, std::span<const Box> parts);

}  // namespace boxwood
