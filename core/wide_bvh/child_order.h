#pragma once

#include "core/wide_bvh/wide_bvh.h"

namespace boxwood {

/// Fills in `orders` of a node whose children are known.
///
/// Of two children the nearer one, for the rays of an octant with the signs s, is the one that lies before
/// the other along more of the axes: a if sum over the axes of s (c_b - c_a) / (h_b + h_a) > 0, c the centres
/// and h the half extents of their boxes. A term beyond 1 means that a plane separates them, which every ray
/// of the octant crosses in the same direction. Children are sorted by the number of others that they are
/// before. Dammertz, Hanika, Keller 2008, section 3.2, sort by the signs along the axes of the splits.
/// Differs: no splits are known here, and split axes do not tell how far apart the children are.
template <uint32_t Width>
void set_order(typename WideBvh<Width>::Node& node);

}  // namespace boxwood
