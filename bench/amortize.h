#pragma once

#include <span>
#include <string>
#include <vector>

#include "bench/structures.h"
#include "core/measure/report.h"

namespace boxwood::bench {

/// Decades of rays: 10^kLeastRays to 10^kMostRays.
inline constexpr int kLeastRays = 4, kMostRays = 10;

enum class RaysKind : uint8_t { Primary, Diffuse };
inline constexpr const char* kRaysKindNames[] = {"primary", "diffuse"};

/// Build plus trace of so many rays by one structure.
struct AmortizedRow {
    size_t structure;  ///< index of the one measured
    RaysKind kind;
    double rays;
    double total_ms;    ///< build time + rays / rate
    double efficiency;  ///< rays over total time, over the rate of the fastest structure without its build
    bool wins;          ///< no other structure takes less time
};

/// For each kind of rays and each decade, every structure that was built, in their order.
/// Karras, Aila, "Fast Parallel Construction of High-Quality Bounding Volume Hierarchies", HPG 2013, figure
/// 1, as Kerbl's lecture shows it: efficiency as a function of the total time, build included.
std::vector<AmortizedRow> amortize(std::span<const MeasuredStructure> structures);

ReportRow report_row(const AmortizedRow& row, const MeasuredStructure& structure, const Scene& scene);
/// One line for each kind and decade: who wins, in what time, and who comes second.
std::vector<ReportRow> winner_rows(std::span<const AmortizedRow> rows,
                                   std::span<const MeasuredStructure> structures, const Scene& scene);

}  // namespace boxwood::bench
