#include "bench/amortize.h"

#include <algorithm>
#include <cmath>

namespace boxwood::bench {
namespace {

const Rate& rate_of(const MeasuredStructure& structure, RaysKind kind) {
    return kind == RaysKind::Primary ? structure.primary : structure.diffuse;
}

const char* name_of(RaysKind kind) { return kRaysKindNames[static_cast<size_t>(kind)]; }

/// All structures on one number of rays; `best_rate` in rays per millisecond.
void add_decade(std::span<const MeasuredStructure> structures, RaysKind kind, double rays, double best_rate,
                std::vector<AmortizedRow>& rows) {
    const size_t first = rows.size();
    for (size_t i = 0; i < structures.size(); ++i) {
        const double rate = 1000.0 * rate_of(structures[i], kind).mrays_per_s();
        if (!structures[i].is_built || !std::isfinite(rate)) continue;
        const double total = structures[i].build_ms + rays / rate;
        rows.push_back({i, kind, rays, total, rays / total / best_rate, false});
    }
    const auto own = std::span(rows).subspan(first);
    if (!own.empty()) std::ranges::min_element(own, {}, &AmortizedRow::total_ms)->wins = true;
}

}  // namespace

std::vector<AmortizedRow> amortize(std::span<const MeasuredStructure> structures) {
    std::vector<AmortizedRow> rows;
    for (const RaysKind kind : {RaysKind::Primary, RaysKind::Diffuse}) {
        double best_rate = 0.0;
        for (const MeasuredStructure& structure : structures) {
            const double rate = 1000.0 * rate_of(structure, kind).mrays_per_s();
            if (structure.is_built && rate > best_rate) best_rate = rate;
        }
        for (int decade = kLeastRays; decade <= kMostRays; ++decade)
            add_decade(structures, kind, std::pow(10.0, decade), best_rate, rows);
    }
    return rows;
}

ReportRow report_row(const AmortizedRow& row, const MeasuredStructure& structure, const Scene& scene) {
    ReportRow cells;
    cells.set("scene", scene.spec)
        .set("recipe", structure.recipe)
        .set("triangles", uint64_t{scene.mesh.triangle_count()})
        .set("rays_kind", std::string(name_of(row.kind)))
        .set("threads", uint64_t{1})
        .set("build_ms", structure.build_ms)
        .set("mrays_per_s", rate_of(structure, row.kind).mrays_per_s())
        .set("rays", static_cast<uint64_t>(row.rays))
        .set("total_ms", row.total_ms)
        .set("efficiency", row.efficiency)
        .set("wins", row.wins);
    return cells;
}

std::vector<ReportRow> winner_rows(std::span<const AmortizedRow> rows,
                                   std::span<const MeasuredStructure> structures, const Scene& scene) {
    std::vector<ReportRow> result;
    for (const AmortizedRow& row : rows) {
        if (!row.wins) continue;
        const AmortizedRow* second = nullptr;
        for (const AmortizedRow& other : rows) {
            if (other.kind != row.kind || other.rays != row.rays || &other == &row) continue;
            if (second == nullptr || other.total_ms < second->total_ms) second = &other;
        }
        ReportRow cells;
        cells.set("scene", scene.spec)
            .set("rays_kind", std::string(name_of(row.kind)))
            .set("rays", static_cast<uint64_t>(row.rays))
            .set("winner", structures[row.structure].recipe)
            .set("total_ms", row.total_ms)
            .set("efficiency", row.efficiency);
        if (second != nullptr)
            cells.set("second", structures[second->structure].recipe).set("second_ms", second->total_ms);
        result.push_back(std::move(cells));
    }
    return result;
}

}  // namespace boxwood::bench
