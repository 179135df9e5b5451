#include "core/measure/end_point_overlap.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <span>

#include "core/base/parallel.h"
#include "core/measure/area_inside.h"
#include "core/measure/search_boxes.h"

namespace boxwood {
namespace {

constexpr size_t kBatches = 256;        ///< of triangles; sums of batches are added in order
constexpr size_t kLookAfter = 1 << 12;  ///< boxes between two looks at the task

/// For each primitive the leaves that hold it.
struct PrimLeaves {
    std::vector<uint32_t> begin, leaf;  ///< those of p: leaf[begin[p] .. begin[p + 1])
};

PrimLeaves list_prim_leaves(const NodeList& list, size_t triangle_count) {
    PrimLeaves leaves;
    leaves.begin.assign(triangle_count + 1, 0);
    const auto for_each = [&](const auto& body) {
        for (uint32_t n = 0; n < list.nodes.size(); ++n) {
            const NodeView& node = list.nodes[n];
            if (node.kind != NodeKind::Leaf) continue;
            for (uint32_t r = 0; r < node.ref_count; ++r) body(list.ref_prims[node.first_ref + r], n);
        }
    };
    for_each([&](uint32_t prim, uint32_t) { ++leaves.begin[prim + 1]; });
    for (size_t i = 1; i < leaves.begin.size(); ++i) leaves.begin[i] += leaves.begin[i - 1];
    leaves.leaf.resize(leaves.begin.back());
    std::vector<uint32_t> next(leaves.begin.begin(), leaves.begin.end() - 1);
    for_each([&](uint32_t prim, uint32_t node) { leaves.leaf[next[prim]++] = node; });
    return leaves;
}

/// Which nodes are above a reference of the primitive at hand: one entry for each node, taken by one thread
/// at a time and never cleared, since every primitive comes once.
class MarkPool {
public:
    using Marks = std::vector<uint32_t>;

    explicit MarkPool(size_t node_count) : node_count_(node_count) {}
    std::unique_ptr<Marks> take() {
        {
            const std::scoped_lock lock(mutex_);
            if (!free_.empty()) {
                std::unique_ptr<Marks> marks = std::move(free_.back());
                free_.pop_back();
                return marks;
            }
        }
        return std::make_unique<Marks>(node_count_, kNoIndex);
    }
    void give_back(std::unique_ptr<Marks> marks) {
        const std::scoped_lock lock(mutex_);
        free_.push_back(std::move(marks));
    }

private:
    size_t node_count_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Marks>> free_;
};

bool meet(const Box& a, const Box& b) {
    return a.lower.x <= b.upper.x && b.lower.x <= a.upper.x && a.lower.y <= b.upper.y &&
           b.lower.y <= a.upper.y && a.lower.z <= b.upper.z && b.lower.z <= a.upper.z;
}

class Overlap {
public:
    Overlap(const NodeList& list, const Mesh& mesh, double traversal_cost, double intersection_cost)
        : list_(list),
          mesh_(mesh),
          boxes_(search_boxes(list)),
          leaves_(list_prim_leaves(list, mesh.triangle_count())) {
        costs_.reserve(list.nodes.size());
        for (const NodeView& node : list.nodes)
            costs_.push_back(node.kind == NodeKind::Inner ? traversal_cost
                                                          : leaf_cost(node.ref_count, intersection_cost));
    }

    /// Adds to sums[level] the cost times area that the primitive causes at that level.
    void add(uint32_t prim, std::span<uint32_t> marks, std::span<double> sums, const Task& task) const {
        mark_nodes_above(prim, marks);
        const Triangle triangle = mesh_.triangle(prim);
        const Box bounds = triangle.bounds();
        size_t looked_at = 0;
        for (size_t i = 0; i < boxes_.size();) {
            if (++looked_at % kLookAfter == 0 && task.stopped()) return;
            const SearchBox& box = boxes_[i];
            if (!meet(box.bounds, bounds)) {
                i = box.end;
                continue;
            }
            ++i;
            const bool is_node = box.node != kNoIndex;
            if (is_node && marks[box.node] == prim) continue;
            const double area = area_inside(triangle, box.bounds);
            if (!(area > 0.0)) {
                i = box.end;
            } else if (is_node) {
                sums[list_.nodes[box.node].level] += costs_[box.node] * area;
            }
        }
    }

private:
    void mark_nodes_above(uint32_t prim, std::span<uint32_t> marks) const {
        for (uint32_t i = leaves_.begin[prim]; i < leaves_.begin[prim + 1]; ++i)
            for (uint32_t node = leaves_.leaf[i]; node != kNoIndex && marks[node] != prim;
                 node = list_.nodes[node].parent)
                marks[node] = prim;
    }

    const NodeList& list_;
    const Mesh& mesh_;
    std::vector<SearchBox> boxes_;
    PrimLeaves leaves_;
    std::vector<double> costs_;
};

}  // namespace

EndPointOverlap end_point_overlap(const NodeList& list, const Mesh& mesh, Task& task, double traversal_cost,
                                  double intersection_cost) {
    EndPointOverlap result;
    if (!has_nested_boxes(list)) return result;
    result.total = 0.0;
    uint32_t level_count = 0;
    for (const NodeView& node : list.nodes) level_count = std::max(level_count, node.level + 1);
    result.levels.assign(level_count, 0.0);
    const size_t count = mesh.triangle_count();
    double scene_area = 0.0;
    for (uint32_t prim = 0; prim < count; ++prim) scene_area += area_of(mesh.triangle(prim));
    if (!(scene_area > 0.0)) return result;

    task.done = 0;
    task.total = count;
    const Overlap overlap(list, mesh, traversal_cost, intersection_cost);
    const size_t grain = (count + kBatches - 1) / kBatches;
    std::vector<std::vector<double>> sums((count + grain - 1) / grain, std::vector<double>(level_count, 0.0));
    MarkPool pool(list.nodes.size());
    parallel_for(count, grain, [&](size_t begin, size_t end) {
        std::unique_ptr<MarkPool::Marks> marks = pool.take();
        for (size_t prim = begin; prim < end && !task.stopped(); ++prim)
            overlap.add(static_cast<uint32_t>(prim), *marks, sums[begin / grain], task);
        pool.give_back(std::move(marks));
        task.done += end - begin;
    });
    for (size_t level = 0; level < level_count; ++level) {
        for (const std::vector<double>& batch : sums) result.levels[level] += batch[level];
        result.levels[level] /= scene_area;
        result.total += result.levels[level];
    }
    return result;
}

}  // namespace boxwood
