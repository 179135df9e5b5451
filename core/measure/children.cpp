#include "core/measure/children.h"

namespace boxwood {

Children list_children(const std::vector<NodeView>& nodes) {
    Children children;
    children.begin.assign(nodes.size() + 1, 0);
    for (const NodeView& node : nodes)
        if (node.parent != kNoIndex) ++children.begin[node.parent + 1];
    for (size_t i = 1; i < children.begin.size(); ++i) children.begin[i] += children.begin[i - 1];
    children.child.resize(children.begin.back());
    std::vector<uint32_t> next(children.begin.begin(), children.begin.end() - 1);
    for (uint32_t i = 0; i < nodes.size(); ++i)
        if (nodes[i].parent != kNoIndex) children.child[next[nodes[i].parent]++] = i;
    return children;
}

}  // namespace boxwood
