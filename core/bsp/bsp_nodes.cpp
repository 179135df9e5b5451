#include "core/bsp/bsp_tree.h"
#include "core/bsp/convex_cell.h"

namespace boxwood {

namespace {

/// Each edge of a cell lies at two faces, which run along it in opposite directions.
void add_outline(uint32_t node, const ConvexCell& cell, std::vector<OutlineSegment>& outlines) {
    for (const ConvexCell::Polygon& face : cell.faces()) {
        for (size_t i = 0; i < face.size(); ++i) {
            const DVec3 &p = face[i], &q = face[(i + 1) % face.size()];
            const bool ascends = p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
            const Vec3 from(p), to(q);
            if (ascends && from != to) outlines.push_back({node, from, to});
        }
    }
}

Box common_box(const Box& a, const Box& b) {
    return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
}

}  // namespace

NodeList BspTree::list_nodes() const {
    NodeList list;
    list.nodes.resize(nodes.size());
    list.ref_prims = prims;
    if (nodes.empty()) return list;
    // Depth first, as the nodes stand, so that cells are kept of one path and its siblings alone.
    std::vector<ConvexCell> cells{ConvexCell(bounds)};
    list.nodes[0].bounds = bounds;
    for (uint32_t i = 0; i < nodes.size(); ++i) {
        const ConvexCell cell = std::move(cells.back());
        cells.pop_back();
        add_outline(i, cell, list.outlines);
        const Node& node = nodes[i];
        NodeView& view = list.nodes[i];
        if (node.is_leaf()) {
            view.first_ref = node.first();
            view.ref_count = node.count();
            continue;
        }
        view.kind = NodeKind::Inner;
        auto [left, right] = cell.cut(PlaneValue(plane_of(node)));
        list.nodes[i + 1].bounds = common_box(left.bounds(), view.bounds);
        list.nodes[node.right()].bounds = common_box(right.bounds(), view.bounds);
        for (const uint32_t child : {i + 1, node.right()}) {
            list.nodes[child].parent = i;
            list.nodes[child].level = view.level + 1;
        }
        cells.push_back(std::move(right));
        cells.push_back(std::move(left));
    }
    return list;
}

}  // namespace boxwood
