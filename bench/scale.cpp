#include "bench/scale.h"

#include <algorithm>
#include <cmath>

namespace boxwood::bench {

namespace {

double per_triangle(double value, const PeerRow& row) {
    return value / static_cast<double>(std::max<uint64_t>(row.triangles, 1));
}

/// Largest over least.
double factor_of(const std::vector<double>& values) {
    const auto [least, most] = std::ranges::minmax(values);
    return most / least;
}

/// The most that a value lies below one before it, as a factor; 1 where they only grow.
double fall_of(const std::vector<double>& values) {
    double highest = 0.0, fall = 1.0;
    for (const double value : values) {
        highest = std::max(highest, value);
        fall = std::max(fall, highest / value);
    }
    return fall;
}

ReportRow& add_per_triangle(ReportRow& cells, const PeerRow& row) {
    return cells.set("build_ns_per_triangle", per_triangle(1e6 * row.build_ms, row))
        .set("bytes_per_triangle", per_triangle(static_cast<double>(row.bytes), row))
        .set("mrays_by_log2", rate_by_depth(row));
}

bool is_same_series(const PeerRow& a, const PeerRow& b) {
    return a.contestant == b.contestant && a.mode == b.mode && a.rays_kind == b.rays_kind &&
           a.threads == b.threads;
}

}  // namespace

double rate_by_depth(const PeerRow& row) {
    return row.mrays_per_s() * std::log2(static_cast<double>(std::max<uint64_t>(row.triangles, 2)));
}

std::vector<ScaleSummary> summarize_scale(std::span<const PeerRow> rows) {
    std::vector<ScaleSummary> summaries;
    for (size_t i = 0; i < rows.size(); ++i) {
        const PeerRow& first = rows[i];
        const auto is_own = [&](const PeerRow& row) { return is_same_series(row, first); };
        if (std::ranges::any_of(rows.first(i), is_own)) continue;
        std::vector<PeerRow> series;
        std::ranges::copy_if(rows, std::back_inserter(series), is_own);
        std::ranges::sort(series, {}, &PeerRow::triangles);
        std::vector<double> build, bytes, rates;
        for (const PeerRow& row : series) {
            build.push_back(per_triangle(row.build_ms, row));
            bytes.push_back(per_triangle(static_cast<double>(row.bytes), row));
            rates.push_back(rate_by_depth(row));
        }
        ScaleSummary summary;
        summary.contestant = first.contestant;
        summary.mode = first.mode;
        summary.rays_kind = first.rays_kind;
        summary.threads = first.threads;
        summary.least_triangles = series.front().triangles;
        summary.most_triangles = series.back().triangles;
        summary.build_factor = factor_of(build);
        summary.bytes_factor = factor_of(bytes);
        summary.rate_fall = fall_of(rates);
        summaries.push_back(std::move(summary));
    }
    return summaries;
}

ReportRow scale_row(const PeerRow& row) {
    ReportRow cells = report_row(row);
    return add_per_triangle(cells, row);
}

ReportRow short_scale_row(const PeerRow& row) {
    ReportRow cells;
    cells.set("triangles", row.triangles)
        .set("rays_kind", row.rays_kind)
        .set("threads", static_cast<uint64_t>(row.threads))
        .set("contestant", row.contestant)
        .set("build_ms", row.build_ms)
        .set("mrays_per_s", row.mrays_per_s())
        .set("ratio", row.ratio.value)
        .set("wrong", row.errors.wrong());
    return add_per_triangle(cells, row);
}

ReportRow report_row(const ScaleSummary& summary) {
    return ReportRow()
        .set("contestant", summary.contestant)
        .set("mode", summary.mode)
        .set("rays_kind", summary.rays_kind)
        .set("threads", static_cast<uint64_t>(summary.threads))
        .set("least_triangles", summary.least_triangles)
        .set("most_triangles", summary.most_triangles)
        .set("build_factor", summary.build_factor)
        .set("bytes_factor", summary.bytes_factor)
        .set("rate_fall", summary.rate_fall);
}

}  // namespace boxwood::bench
