#include "core/refs/subdivision.h"

#include <algorithm>
#include <cmath>

#include "core/base/assert.h"
#include "core/base/parallel.h"

namespace boxwood {

namespace {

constexpr size_t kTriangleGrain = 1024;  // triangles of one parallel range
constexpr size_t kPiecesPerLook = 256;   // pieces between two looks at the stop request and the budget

/// References of each triangle under one limit.
struct Counts {
    std::vector<uint32_t> pieces;
    size_t tight_count = 0;
    bool within_budget = true;  ///< false: the counts are not complete
};

class Subdivision {
public:
    Subdivision(const Mesh& mesh, const SubdivisionRule& rule, size_t most, Task& task)
        : mesh_(mesh), rule_(rule), most_(most), task_(task) {}

    Counts count(double limit) const {
        Counts counts;
        counts.pieces.assign(mesh_.triangle_count(), 1);
        std::atomic<size_t> tight_count{0}, total{mesh_.triangle_count()};
        parallel_for(mesh_.triangle_count(), kTriangleGrain, [&](size_t begin, size_t end) {
            size_t tight = 0;
            for (size_t i = begin; i < end && !task_.stopped(); ++i) {
                const Triangle triangle = mesh_.triangle(static_cast<uint32_t>(i));
                if (rule_.measure(triangle) <= limit) {
                    ++tight;
                } else {
                    counts.pieces[i] = count_pieces(triangle, limit, total);
                }
                if (total > most_) return;
            }
            tight_count += tight;
        });
        counts.tight_count = tight_count;
        counts.within_budget = total <= most_;
        return counts;
    }

    uint64_t tight_count(double limit) const {
        uint64_t tight = 0;
        for (size_t i = 0; i < mesh_.triangle_count(); ++i)
            if (rule_.measure(mesh_.triangle(static_cast<uint32_t>(i))) <= limit) ++tight;
        return tight;
    }

    /// The rule's limit doubled as often as it takes, which is at least once: found by steps of growing width
    /// from a guess, then by bisection.
    double smallest_limit_within_budget() const {
        int few = 0, enough = kMostDoublings;  // known not to be enough, and to be enough
        const int guess = std::max(1, guess_doublings());
        const auto look = [&](int doublings) {
            const bool is_enough = doublings >= enough || count(doubled(doublings)).within_budget;
            (is_enough ? enough : few) = doublings;
            return is_enough;
        };
        if (guess < enough && look(guess)) {
            for (int step = 1; guess - step > few && look(guess - step);) step *= 2;
        } else {
            for (int step = 1; guess + step < enough && !look(guess + step);) step *= 2;
        }
        while (few + 1 < enough && !task_.stopped()) look(few + (enough - few) / 2);
        return doubled(enough);
    }

    References fill(const Counts& counts, double limit) const {
        References result;
        std::vector<size_t> first(counts.pieces.size() + 1, 0);
        for (size_t i = 0; i < counts.pieces.size(); ++i) {
            first[i + 1] = first[i] + counts.pieces[i];
            if (counts.pieces[i] > 1) ++result.split_count;
        }
        result.refs.resize(first.back());
        parallel_for(mesh_.triangle_count(), kTriangleGrain, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end && !task_.stopped(); ++i) {
                const std::span<PrimRef> refs = std::span(result.refs).subspan(first[i], counts.pieces[i]);
                fill_pieces(static_cast<uint32_t>(i), limit, refs);
            }
            task_.done += end - begin;
        });
        return result;
    }

private:
    static constexpr int kMostDoublings = 4096;  // from the least double to above the largest

    double doubled(int times) const {
        return times >= kMostDoublings ? rule_.largest
                                       : std::min(std::ldexp(rule_.limit, times), rule_.largest);
    }

    /// Doublings after which the expected number of pieces is within the budget.
    int guess_doublings() const {
        std::vector<double> measures(mesh_.triangle_count());
        for (size_t i = 0; i < measures.size(); ++i)
            measures[i] = rule_.measure(mesh_.triangle(static_cast<uint32_t>(i)));
        int few = 0, enough = kMostDoublings;
        while (few + 1 < enough) {
            const int middle = few + (enough - few) / 2;
            double pieces = 0.0;
            for (const double measure : measures)
                pieces += std::max(1.0, std::pow(measure / doubled(middle), rule_.growth));
            (pieces <= static_cast<double>(most_) ? enough : few) = middle;
        }
        return enough;
    }

    /// Adds all but one to `total`, which counts each triangle once from the start. Stops early beyond the
    /// budget.
    uint32_t count_pieces(const Triangle& triangle, double limit, std::atomic<size_t>& total) const {
        size_t pieces = 0, added = 1;
        rule_.cut(triangle, limit, [&](const Box&) {
            if (++pieces % kPiecesPerLook != 0) return true;
            total += pieces - added;
            added = pieces;
            return total <= most_ && !task_.stopped();
        });
        total += pieces - added;
        return static_cast<uint32_t>(std::min(pieces, kMaxReferences));
    }

    void fill_pieces(uint32_t prim, double limit, std::span<PrimRef> refs) const {
        const Triangle triangle = mesh_.triangle(prim);
        if (refs.size() == 1) {
            refs[0] = {triangle.bounds(), prim};
            return;
        }
        size_t next = 0;
        rule_.cut(triangle, limit, [&](const Box& box) {
            BOXWOOD_ASSERT(next < refs.size());
            refs[next++] = {box, prim};
            return next % kPiecesPerLook != 0 || !task_.stopped();
        });
        BOXWOOD_ASSERT(next == refs.size() || task_.stopped());
    }

    const Mesh& mesh_;
    const SubdivisionRule& rule_;
    size_t most_;
    Task& task_;
};

}  // namespace

References subdivide(const Mesh& mesh, const SubdivisionRule& rule, const ReferenceBudget& budget,
                     Task& task) {
    const size_t triangle_count = mesh.triangle_count();
    const size_t wanted =
        std::max(triangle_count * static_cast<size_t>(budget.per_triangle), budget.at_least);
    const size_t most = std::max(triangle_count, std::min(wanted, kMaxReferences));
    const Subdivision subdivision(mesh, rule, most, task);
    task.total = triangle_count;

    double limit = rule.limit;
    Counts counts = subdivision.count(limit);
    uint64_t tight_count = counts.tight_count;
    if (!counts.within_budget && !task.stopped()) {
        limit = subdivision.smallest_limit_within_budget();
        counts = subdivision.count(limit);
        tight_count = subdivision.tight_count(rule.limit);
        task.skipped.add("over the reference budget", triangle_count - tight_count);
    }
    task.skipped.add("tight", tight_count);
    if (task.stopped()) return {};
    return subdivision.fill(counts, limit);
}

}  // namespace boxwood
