#include "app/viewer/tree_quality.h"

#include <algorithm>
#include <cmath>

#include "app/viewer/number_text.h"

namespace boxwood {
namespace {

std::optional<double> known(double value) {
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Why a slow measure has no value, or the sentence on its value.
std::string state_text(const SlowMeasures* slow, const WorkProgress& progress, double value,
                       const std::string& sentence) {
    if (slow == nullptr && progress.running)
        return "\nBeing measured: " + percent_text(std::max(progress.share, 0.0), 1.0) + ".";
    if (slow == nullptr) return "\nMeasured once the ray-traced picture is done.";
    if (!std::isfinite(value)) return "\nNot defined here: the nodes are no boxes, or have no area.";
    return "\n" + sentence;
}

Measure end_point_quality(const TreeStats& tree, const SlowMeasures* slow, const WorkProgress& progress) {
    Measure row{"epo", "end-point overlap", Measure::Unit::Number, Measure::Better::Lower};
    if (slow != nullptr) row.value = known(slow->end_points.total);
    const double epo = row.value.value_or(std::nan(""));
    row.tip =
        "Cost of what a ray visits around its end though its triangle is elsewhere, in triangle tests: the "
        "sum over all nodes of (area of the surface inside the box whose triangles are not below the node / "
        "area of the surface) x (1 for an inner node, the number of primitives for a leaf). Lower is "
        "better. Aila, Karras, Laine 2013." +
        state_text(slow, progress, epo,
                   "Here " + number_text(epo) + ", beside a SAH cost of " + number_text(tree.sah_cost) +
                       ", which does not see where surfaces are.");
    return row;
}

Measure leaf_count_quality(const SlowMeasures* slow, const WorkProgress& progress) {
    Measure row{"lcv", "leaf count variability", Measure::Unit::Number, Measure::Better::Lower};
    if (slow != nullptr) row.value = known(slow->leaf_counts.deviation);
    const double deviation = row.value.value_or(std::nan(""));
    const double mean = slow != nullptr ? slow->leaf_counts.mean : 0.0;
    row.tip =
        "Standard deviation of the number of leaves that a random line through the root's box meets, from "
        "65,536 lines. Where it is large, rays that go together take different times. Lower is better. "
        "Aila, Karras, Laine 2013." +
        state_text(slow, progress, deviation,
                   "Here " + number_text(mean) + " leaves in the mean, give or take " +
                       number_text(deviation) + ".");
    return row;
}

}  // namespace

std::vector<Measure> tree_qualities(const TreeStats& tree, const SlowMeasures* slow,
                                    const WorkProgress& progress) {
    const std::string crowded = tree.crowded_parents == 0
                                    ? ""
                                    : "\n" + grouped(tree.crowded_parents) + " parents of more than " +
                                          grouped(TreeStats::kMostSiblings) + " nodes are left out.";
    return {
        end_point_quality(tree, slow, progress),
        leaf_count_quality(slow, progress),
        {"leaf_size_variation", "leaf-size variation", Measure::Unit::Share, Measure::Better::Lower,
         tree.leaf_size_variation,
         "Standard deviation of the number of primitives in a leaf over its mean; empty leaves left out. "
         "Lower is better.\nHere " +
             number_text(tree.mean_leaf_size) + " primitives in the mean, give or take " +
             number_text(tree.leaf_size_variation * tree.mean_leaf_size) + "."},
        {"overlap", "overlap", Measure::Unit::Number, Measure::Better::Lower, tree.sibling_overlap,
         "Sum of the areas of all siblings' common boxes / area of the root's box: as many of them a random "
         "ray meets, each of which makes it visit both siblings. Lower is better.\nHere " +
             number_text(tree.sibling_overlap) + " of them." + crowded},
        {"empty_volume", "empty volume", Measure::Unit::Share, Measure::Better::Neither, tree.empty_volume,
         "Share of an inner node's box that no child covers (of its area where it is flat), the mean over "
         "all of them weighted by area. Neither is better: what is empty lets rays through early, and was "
         "visited for it.\nHere " +
             percent_text(tree.empty_volume, 1.0) + "." + crowded}};
}

}  // namespace boxwood
