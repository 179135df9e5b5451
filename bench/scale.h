#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/peers.h"

namespace boxwood::bench {

/// One contestant over scenes of growing size: how far each figure is from what the size alone explains.
struct ScaleSummary {
    std::string contestant, mode, rays_kind;
    int threads = 1;
    uint64_t least_triangles = 0, most_triangles = 0;
    double build_factor = 0.0;  ///< build time per triangle: the largest over the least
    double bytes_factor = 0.0;  ///< bytes per triangle, likewise
    double rate_fall =
        0.0;  ///< rays per second times log2 N: most that a size has lost against a smaller one
};

/// Rays per second times log2 of the number of triangles: even where the cost of a ray grows with the depth
/// of a balanced tree.
double rate_by_depth(const PeerRow& row);

/// Of the rows of all sizes, in the order in which contestants first occur.
std::vector<ScaleSummary> summarize_scale(std::span<const PeerRow> rows);

/// The row with what it is per triangle.
ReportRow scale_row(const PeerRow& row);
/// What the table shows of it.
ReportRow short_scale_row(const PeerRow& row);
ReportRow report_row(const ScaleSummary& summary);

}  // namespace boxwood::bench
