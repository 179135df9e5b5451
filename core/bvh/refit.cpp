#include "core/bvh/refit.h"

#include <string>

#include "core/base/assert.h"
#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/scene/frame.h"

namespace boxwood {
namespace {

constexpr size_t kSerialNodes = 4096;     ///< a smaller tree is refitted by one thread
constexpr uint32_t kParallelLevels = 10;  ///< below them one thread has the rest of a branch

class Refitting {
public:
    Refitting(const Mesh& mesh, Bvh2& bvh, const Task& task) : mesh_(mesh), bvh_(bvh), task_(task) {}

    Box refit(uint32_t index, uint32_t depth) {
        Bvh2::Node& node = bvh_.nodes[index];
        if (task_.stopped()) return {node.lower, node.upper};
        const Box box = node.is_leaf() ? box_of_leaf(node) : box_of_children(node.first, depth);
        // Written only where it is another one: 0 and -0 stay as the builder left them.
        if (box != Box{node.lower, node.upper}) {
            node.lower = box.lower;
            node.upper = box.upper;
        }
        return box;
    }

private:
    Box box_of_leaf(const Bvh2::Node& leaf) const {
        Box box;
        for (uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
            BOXWOOD_ASSERT(bvh_.prims[i] < mesh_.triangle_count());
            box.extend(mesh_.triangle(bvh_.prims[i]).bounds());
        }
        return box;
    }
    Box box_of_children(uint32_t left, uint32_t depth) {
        Box first, second;
        if (depth < kParallelLevels && bvh_.nodes.size() > kSerialNodes) {
            parallel_invoke([&] { first = refit(left, depth + 1); },
                            [&] { second = refit(left + 1, depth + 1); });
        } else {
            first = refit(left, depth + 1);
            second = refit(left + 1, depth + 1);
        }
        first.extend(second);
        return first;
    }

    const Mesh& mesh_;
    Bvh2& bvh_;
    const Task& task_;
};

}  // namespace

void Refit::describe(ParamVisitor& v) {
    v.on_int("from", from, 0, kMostFrames - 1, "frame of the animated scene that the tree is built on");
}

Bvh2 Refit::apply(const Mesh& mesh, std::span<const PrimRef>, const Bvh2& input, Task& task) const {
    if (input.prims.size() > mesh.triangle_count())
        throw Error(ExitCode::WrongUsage, "refit needs whole triangles, but the tree before it holds " +
                                              std::to_string(input.prims.size()) + " references to " +
                                              std::to_string(mesh.triangle_count()) + " of them");
    Bvh2 bvh = input;
    if (!bvh.nodes.empty()) Refitting(mesh, bvh, task).refit(0, 0);
    return bvh;
}

}  // namespace boxwood
