#include "core/measure/search_boxes.h"

#include <algorithm>

#include "core/measure/children.h"

namespace boxwood {
namespace {

constexpr size_t kMostChildren = 8;  ///< of an entry: wide nodes and octree cells stay as they are

class SearchBoxMaker {
public:
    explicit SearchBoxMaker(const std::vector<NodeView>& nodes)
        : nodes_(nodes), children_(list_children(nodes)) {
        boxes_.reserve(nodes.size());
    }

    std::vector<SearchBox> make() {
        if (!nodes_.empty()) add_node(0);
        return std::move(boxes_);
    }

private:
    void add_node(uint32_t node) {
        const size_t place = boxes_.size();
        boxes_.push_back({.bounds = nodes_[node].bounds, .node = node});
        add_siblings(std::span(children_.child)
                         .subspan(children_.begin[node], children_.begin[node + 1] - children_.begin[node]));
        boxes_[place].end = static_cast<uint32_t>(boxes_.size());
    }
    /// Reorders them.
    void add_siblings(std::span<uint32_t> siblings) {
        if (siblings.size() <= kMostChildren) {
            for (const uint32_t node : siblings) add_node(node);
            return;
        }
        Box centers;
        for (const uint32_t node : siblings) centers.extend(Vec3(nodes_[node].bounds.center()));
        const int axis = centers.largest_axis();
        const size_t half = siblings.size() / 2;
        std::ranges::nth_element(
            siblings, siblings.begin() + static_cast<std::ptrdiff_t>(half), {},
            [&](uint32_t node) { return std::pair(nodes_[node].bounds.center()[axis], node); });
        add_group(siblings.first(half));
        add_group(siblings.subspan(half));
    }
    void add_group(std::span<uint32_t> siblings) {
        const size_t place = boxes_.size();
        SearchBox& group = boxes_.emplace_back();
        for (const uint32_t node : siblings) group.bounds.extend(nodes_[node].bounds);
        add_siblings(siblings);
        boxes_[place].end = static_cast<uint32_t>(boxes_.size());
    }

    const std::vector<NodeView>& nodes_;
    Children children_;
    std::vector<SearchBox> boxes_;
};

}  // namespace

bool has_nested_boxes(const NodeList& list) {
    return list.is_nested && list.half_areas.empty() && list.outlines.empty();
}

std::vector<SearchBox> search_boxes(const NodeList& list) { return SearchBoxMaker(list.nodes).make(); }

}  // namespace boxwood
