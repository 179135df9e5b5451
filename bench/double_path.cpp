#include "bench/double_path.h"

#include <algorithm>
#include <cmath>

#include "core/structure/closest.h"

namespace boxwood::bench {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct DoubleRay {
    DVec3 origin, direction, inverse;
    double t_min, t_max;

    explicit DoubleRay(const Ray& ray)
        : origin(ray.origin),
          direction(ray.direction),
          inverse(1.0 / direction),
          t_min(static_cast<double>(ray.t_min)),
          t_max(static_cast<double>(ray.t_max)) {}

    /// Slabs; a NaN keeps the other bound.
    bool meets(const Vec3& lower, const Vec3& upper, double limit, double& entry) const {
        double t0 = t_min, t1 = limit;
        for (int axis = 0; axis < 3; ++axis) {
            const double p = (static_cast<double>(lower[axis]) - origin[axis]) * inverse[axis];
            const double q = (static_cast<double>(upper[axis]) - origin[axis]) * inverse[axis];
            const double near = p < q ? p : q, far = p < q ? q : p;
            t0 = near > t0 ? near : t0;
            t1 = far < t1 ? far : t1;
        }
        entry = t0;
        return t0 <= t1;
    }

    /// t of the hit, infinity for a miss.
    double intersect(const Triangle& triangle) const {
        const DVec3 a(triangle.a), e1 = DVec3(triangle.b) - a, e2 = DVec3(triangle.c) - a;
        const DVec3 p = glm::cross(direction, e2);
        const double determinant = glm::dot(e1, p);
        if (determinant == 0.0) return kInfinity;
        const double inverse_determinant = 1.0 / determinant;
        const DVec3 s = origin - a;
        const double u = glm::dot(s, p) * inverse_determinant;
        if (!(u >= 0.0 && u <= 1.0)) return kInfinity;
        const DVec3 q = glm::cross(s, e1);
        const double v = glm::dot(direction, q) * inverse_determinant;
        if (!(v >= 0.0 && u + v <= 1.0)) return kInfinity;
        const double t = glm::dot(e2, q) * inverse_determinant;
        return t >= t_min && t <= t_max ? t : kInfinity;
    }
};

}  // namespace

std::optional<DoubleTracer> DoubleTracer::over(const NodeList& list) {
    const size_t count = list.nodes.size();
    std::vector<uint32_t> child_counts(count), first_children(count), places(count);
    for (const NodeView& view : list.nodes)
        if (view.parent != kNoIndex && ++child_counts[view.parent] > kMaxChildren) return std::nullopt;
    // Parents come before children, so this gives every family adjacent places after the root's.
    uint32_t next = 1;
    for (size_t i = 0; i < count; ++i) {
        first_children[i] = next;
        next += child_counts[i];
    }
    std::vector<uint32_t> used(count);
    for (size_t i = 0; i < count; ++i) {
        const uint32_t parent = list.nodes[i].parent;
        places[i] = parent == kNoIndex ? 0 : first_children[parent] + used[parent]++;
    }
    DoubleTracer tracer;
    tracer.prims_ = list.ref_prims;
    tracer.nodes_.resize(count);
    for (size_t i = 0; i < count; ++i) {
        const NodeView& view = list.nodes[i];
        const bool is_leaf = view.kind == NodeKind::Leaf;
        tracer.nodes_[places[i]] = {view.bounds.lower, is_leaf ? view.first_ref : first_children[i],
                                    view.bounds.upper, is_leaf ? view.ref_count | kLeafBit : child_counts[i]};
    }
    return tracer;
}

template <class Counter>
Hit DoubleTracer::closest_hit(const Mesh& mesh, const Ray& ray, std::vector<StackEntry>& stack,
                              Counter& count) const {
    const DoubleRay r(ray);
    double best = kInfinity, limit = r.t_max;
    uint32_t best_prim = kNoIndex;
    stack.clear();
    double entry;
    count.visit_node(0);
    if (!nodes_.empty() && r.meets(nodes_[0].lower, nodes_[0].upper, limit, entry))
        stack.push_back({0, entry});
    while (!stack.empty()) {
        const StackEntry top = stack.back();
        stack.pop_back();
        if (top.entry > limit) continue;
        const Node& node = nodes_[top.node];
        const uint32_t end = node.first + (node.count & ~kLeafBit);
        if ((node.count & kLeafBit) != 0) {
            for (uint32_t i = node.first; i < end; ++i) {
                count.test_primitive();
                const double t = r.intersect(mesh.triangle(prims_[i]));
                if (t < best || (t == best && t < kInfinity && prims_[i] < best_prim)) {
                    best = t;
                    best_prim = prims_[i];
                    limit = t;
                }
            }
            continue;
        }
        const auto base = static_cast<std::ptrdiff_t>(stack.size());
        for (uint32_t child = node.first; child < end; ++child) {
            count.visit_node(child);
            if (!r.meets(nodes_[child].lower, nodes_[child].upper, limit, entry)) continue;
            auto place = stack.end();
            while (place != stack.begin() + base && (place - 1)->entry < entry) --place;
            stack.insert(place, {child, entry});  // the nearest last
        }
    }
    return best_prim == kNoIndex ? Hit{} : Hit{static_cast<float>(best), best_prim};
}

void DoubleTracer::closest_hits(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits) const {
    std::vector<StackEntry> stack;
    stack.reserve(1024);
    NoCount count;
    for (size_t i = 0; i < rays.size(); ++i)
        hits[i] = is_valid(rays[i]) ? closest_hit(mesh, rays[i], stack, count) : Hit{};
}

void DoubleTracer::closest_hits_counted(const Mesh& mesh, std::span<const Ray> rays, std::span<Hit> hits,
                                        std::span<Count> counts) const {
    std::vector<StackEntry> stack;
    for (size_t i = 0; i < rays.size(); ++i) {
        counts[i] = {};
        hits[i] = is_valid(rays[i]) ? closest_hit(mesh, rays[i], stack, counts[i]) : Hit{};
    }
}

}  // namespace boxwood::bench
