#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "core/base/vec.h"

namespace boxwood {

/// origin + t * direction for t_min <= t <= t_max. The direction has any length but zero; 0 <= t_min.
struct Ray {
    Vec3 origin{0.0f};
    float t_min = 0.0f;
    Vec3 direction{0.0f, 0.0f, 1.0f};
    float t_max = std::numeric_limits<float>::infinity();
};

/// Nearest intersection: `prim` indexes Mesh::triangles, kNoIndex for a miss; t = infinity for a miss.
struct Hit {
    float t = std::numeric_limits<float>::infinity();
    uint32_t prim = kNoIndex;

    bool is_hit() const { return prim != kNoIndex; }
    bool operator==(const Hit&) const = default;
};

/// How intersections are decided.
enum class Mode : uint8_t {
    Exact,  ///< the answer of exact arithmetic, by an error-bounded filter
    Fast,   ///< float arithmetic; wrong only near edges, vertices and equal distances
};

/// What one or many rays did. A visit: a node whose box was entered or tested as a child; a test: a primitive
/// tested.
struct Count {
    uint64_t nodes = 0;  ///< nodes visited
    uint64_t tests = 0;  ///< primitives tested
    uint64_t exact = 0;  ///< decisions that the filter left to exact arithmetic

    static constexpr bool kCounts = true;
    void visit_node(uint32_t /*node*/) { ++nodes; }
    void test_primitive() { ++tests; }
    void decide_exactly() { ++exact; }
    Count& operator+=(const Count& other) {
        nodes += other.nodes;
        tests += other.tests;
        exact += other.exact;
        return *this;
    }
};

/// Counts the visits of each node of one structure, by its index in NodeList::nodes.
struct NodeVisits {
    std::span<uint32_t> visits;  ///< one for each node; a count stays at its largest value

    static constexpr bool kCounts = true;
    void visit_node(uint32_t node) { visits[node] += visits[node] < kNoIndex ? 1 : 0; }
    void test_primitive() {}
    void decide_exactly() {}
};

/// Compiles to nothing: for timed rays.
struct NoCount {
    static constexpr bool kCounts = false;
    void visit_node(uint32_t /*node*/) {}
    void test_primitive() {}
    void decide_exactly() {}
};

}  // namespace boxwood
