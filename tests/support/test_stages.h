#pragma once

#include "core/brute_force/brute_force.h"
#include "core/bvh/binned_sah.h"
#include "core/catalog/catalog.h"
#include "core/refs/whole_boxes.h"

namespace boxwood {

/// Stages that only tests have, with a parameter of every kind.
struct TestReferences {
    AreaLimit limit;
    int copies = 2;  ///< references for each triangle
    float weight = 0.5f;
    bool clip = false;
    int order = 1;

    void describe(ParamVisitor& v) {
        static constexpr const char* kOrders[] = {"file", "morton", "random"};
        v.on_area_limit("s", "sa", limit, "limit of the area");
        v.on_int("copies", copies, 1, 9, "references for each triangle");
        v.on_float("weight", weight, -2.0f, 2.0f, "a weight");
        v.on_bool("clip", clip, "whether to clip");
        v.on_enum("order", order, kOrders, "an order");
    }
    References make(const Mesh& mesh, Task& task) const {
        References references;
        for (uint32_t prim = 0; prim < mesh.triangle_count(); ++prim)
            for (int i = 0; i < copies; ++i) references.refs.push_back({mesh.triangle(prim).bounds(), prim});
        task.skipped.add("weighed as light", 7);
        return references;
    }
};

/// Takes a BVH and gives it back unchanged.
struct TestTransform {
    using Input = Bvh2;
    using Output = Bvh2;
    int rounds = 1;

    void describe(ParamVisitor& v) { v.on_int("rounds", rounds, 1, 5, "how often"); }
    Bvh2 apply(const Mesh&, std::span<const PrimRef>, const Bvh2& input, Task& task) const {
        task.skipped.add("already good", 3);
        return input;
    }
};

/// A BVH whose nodes are drawn as something else than their boxes: the diagonal in 13 parts.
struct TestDiagonals {
    static constexpr const char* kFamily = "test diagonals";
    Bvh2 bvh;

    template <Mode mode, class Counter>
    void closest_hit(const Mesh& mesh, ClosestHit<mode>& closest, Counter& count) const {
        bvh.closest_hit(mesh, closest, count);
    }
    template <Mode mode, class Counter>
    bool any_hit(const Mesh& mesh, ClosestHit<mode>& ray, Counter& count) const {
        return bvh.any_hit(mesh, ray, count);
    }
    NodeList list_nodes() const {
        constexpr int kParts = 13;
        NodeList list = bvh.list_nodes();
        for (uint32_t node = 0; node < list.nodes.size(); ++node) {
            const Box& box = list.nodes[node].bounds;
            const auto at = [&](int part) {
                const float x = static_cast<float>(part) / kParts;
                return (1.0f - x) * box.lower + x * box.upper;
            };
            for (int part = 0; part < kParts; ++part) list.outlines.push_back({node, at(part), at(part + 1)});
        }
        return list;
    }
    size_t byte_count() const { return bvh.byte_count(); }
};

struct TestDiagonalTransform {
    using Input = Bvh2;
    using Output = TestDiagonals;

    void describe(ParamVisitor&) {}
    TestDiagonals apply(const Mesh&, std::span<const PrimRef>, const Bvh2& input, Task&) const {
        return {input};
    }
};

inline constexpr CatalogEntry kTestReferences[] = {
    row<WholeBoxes>("whole", "whole boxes", "test"),
    row<TestReferences>("copies", "copies of whole boxes", "test"),
};
inline constexpr CatalogEntry kTestBuilders[] = {
    row<BruteForceBuilder>("none", "brute force", "test"),
    row<BinnedSah>("bvh-binned-sah", "BVH, binned SAH", "test"),
};
inline constexpr CatalogEntry kTestTransforms[] = {
    row<TestTransform>("same", "no change", "test"),
    row<TestDiagonalTransform>("diagonals", "drawn as diagonals", "test"),
};
inline constexpr Catalog kTestCatalog{kTestReferences, kTestBuilders, kTestTransforms};

}  // namespace boxwood
