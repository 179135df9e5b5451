#include "app/viewer/pointed.h"

#include <algorithm>
#include <array>

namespace boxwood {
namespace {

bool holds(const Box& box, const Vec3& p) {
    return glm::all(glm::lessThanEqual(box.lower, p)) && glm::all(glm::lessThanEqual(p, box.upper));
}

/// Of some nodes the smallest that holds the point, if it is smaller than the best so far.
void find_smallest(const NodeList& list, std::span<const uint32_t> nodes, const Vec3& point, uint32_t& best) {
    for (const uint32_t node : nodes) {
        const Box& box = list.nodes[node].bounds;
        if (!holds(box, point)) continue;
        if (best == kNoIndex || list.half_area(node) < list.half_area(best)) best = node;
    }
}

}  // namespace

std::optional<Pointed> point_at(const Built& built, const BoxValues& values, const ViewerState& state,
                                const Ray& ray) {
    Pointed pointed;
    built.structure.closest_hits(built.scene->mesh, std::span(&ray, 1), std::span(&pointed.hit, 1),
                                 state.mode, Task{});
    if (!pointed.hit.is_hit()) return std::nullopt;
    pointed.point = ray.origin + pointed.hit.t * ray.direction;
    const std::span<const PrimRef> refs = built.references->refs;
    const auto first_ref = std::ranges::lower_bound(refs, pointed.hit.prim, {}, &PrimRef::prim);
    const auto end_ref = std::ranges::upper_bound(refs, pointed.hit.prim, {}, &PrimRef::prim);
    pointed.hit_references = static_cast<uint32_t>(end_ref - first_ref);
    if (!built.levels || built.levels->level_count() == 0) return pointed;

    const LevelTable& table = *built.levels;
    const size_t deepest = table.level_count() - 1;
    const size_t first = std::min(static_cast<size_t>(state.levels.first), deepest);
    const size_t last = std::min(static_cast<size_t>(state.levels.last), deepest);
    for (size_t level = state.leaves_above ? 0 : first; level <= last; ++level) {
        find_smallest(table.list, level < first ? table.leaves(level) : table.level(level), pointed.point,
                      pointed.node);
    }
    if (pointed.node != kNoIndex) {
        const NodeView& node = table.list.nodes[pointed.node];
        pointed.level = node.level;
        pointed.leaf = node.kind == NodeKind::Leaf;
        pointed.references = static_cast<double>(values.references[pointed.node]);
        pointed.sah_share = static_cast<double>(values.sah_share[pointed.node]);
    }
    return pointed;
}

}  // namespace boxwood
