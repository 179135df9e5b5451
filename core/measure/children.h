#pragma once

#include <span>
#include <vector>

#include "core/structure/node_list.h"

namespace boxwood {

/// Children of each node, ascending.
struct Children {
    std::vector<uint32_t> begin, child;  ///< those of n: child[begin[n] .. begin[n + 1])

    std::span<const uint32_t> of(size_t node) const {
        return std::span(child).subspan(begin[node], begin[node + 1] - begin[node]);
    }
};

Children list_children(const std::vector<NodeView>& nodes);

}  // namespace boxwood
