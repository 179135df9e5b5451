#include "core/volume_bvh/node_content.h"

#include "core/base/parallel.h"
#include "core/refs/clip_polygon.h"

namespace boxwood {

NodeContent::NodeContent(const Mesh& mesh, const Bvh2& bvh, const Task& task)
    : pieces_(bvh.prims.size()), begin_(bvh.nodes.size()), end_(bvh.nodes.size()) {
    if (bvh.nodes.empty()) return;
    std::vector<uint32_t> stack{0}, leaves;
    uint32_t piece_count = 0;
    while (!stack.empty()) {
        const uint32_t i = stack.back();
        const Bvh2::Node& node = bvh.nodes[i];
        stack.pop_back();
        if (node.is_leaf()) {
            begin_[i] = piece_count;
            piece_count += node.count;
            end_[i] = piece_count;
            leaves.push_back(i);
        } else {
            stack.push_back(node.first + 1);
            stack.push_back(node.first);
        }
    }
    for (uint32_t i = static_cast<uint32_t>(bvh.nodes.size()); i-- > 0;) {  // children before parents
        const Bvh2::Node& node = bvh.nodes[i];
        if (node.is_leaf()) continue;
        begin_[i] = begin_[node.first];
        end_[i] = end_[node.first + 1];
    }
    parallel_for(leaves.size(), 256, [&](size_t first, size_t last) {
        for (size_t l = first; l < last && !task.stopped(); ++l) {
            const Bvh2::Node& leaf = bvh.nodes[leaves[l]];
            for (uint32_t k = 0; k < leaf.count; ++k) {
                const uint32_t prim = bvh.prims[leaf.first + k];
                const Triangle triangle = mesh.triangle(prim);
                const Box whole = triangle.bounds();
                Box box = clip_bounds(triangle, {leaf.lower, leaf.upper});
                // A reference that only its rounded box holds has no part; all of it is a part that is safe.
                if (box.is_empty()) box = whole;
                pieces_[begin_[leaves[l]] + k] = {box, prim, box == whole};
            }
        }
    });
}

}  // namespace boxwood
