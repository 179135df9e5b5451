#include <gtest/gtest.h>

#include <bit>

#include "core/base/parallel.h"
#include "core/base/rng.h"
#include "core/catalog/pipeline.h"
#include "core/measure/verify.h"

namespace boxwood {
namespace {

class Hash {
public:
    void add(uint64_t value) { state_ = mix_bits(state_ + 0x9e3779b97f4a7c15ull + mix_bits(value)); }
    void add(float value) { add(uint64_t{std::bit_cast<uint32_t>(value)}); }
    void add(const Vec3& v) {
        add(v.x);
        add(v.y);
        add(v.z);
    }
    uint64_t value() const { return state_; }

private:
    uint64_t state_ = 0;
};

uint64_t hash_of(const NodeList& list) {
    Hash hash;
    for (const NodeView& node : list.nodes) {
        hash.add(node.bounds.lower);
        hash.add(node.bounds.upper);
        hash.add(uint64_t{node.parent});
        hash.add(uint64_t{node.first_ref});
        hash.add(uint64_t{node.ref_count});
    }
    for (const uint32_t prim : list.ref_prims) hash.add(uint64_t{prim});
    return hash.value();
}

uint64_t hash_of(std::span<const Hit> hits) {
    Hash hash;
    for (const Hit& hit : hits) {
        hash.add(hit.t);
        hash.add(uint64_t{hit.prim});
    }
    return hash.value();
}

struct Pinned {
    const char* scene;
    const char* recipe;
    uint64_t nodes;       ///< hash of the node list
    uint64_t exact_hits;  ///< of 2000 verification rays
    uint64_t fast_hits;
};

constexpr Pinned kPinned[] = {
    {"atrium", "bvh-binned-sah", 0x4f40a15287bb0907ull, 0xe82eb49e987a6d2eull, 0x2ab35ae8ba0d4165ull},
    {"atrium", "evh(t=12) > bvh-spatial-median", 0xe0203350d7e4f9e3ull, 0xe82eb49e987a6d2eull,
     0x2ab35ae8ba0d4165ull},
    {"spaceship", "bvh-sweep-sah", 0x13a346d292284b66ull, 0x1acc863c54a4015full, 0xc65c42a9435c01e0ull},
    {"spaceship", "esc(s=8) > bvh-binned-sah", 0x8627533c2b863786ull, 0x1acc863c54a4015full,
     0xc65c42a9435c01e0ull},
};

void expect_pinned(const Pinned& pinned) {
    Task task;
    StageCache cache;
    const std::shared_ptr<const Scene> scene = open_scene(pinned.scene, task);
    const Built built = run_recipe(parse_recipe(pinned.recipe), scene, cache, task).value();
    const std::vector<Ray> rays = verification_rays(*scene, 2000);
    const auto hits = [&](Mode mode) {
        return hash_of(closest_hits(built.structure, scene->mesh, rays, mode, task));
    };
    const std::string place = std::string(pinned.scene) + ", " + pinned.recipe;
    EXPECT_EQ(hash_of(built.structure.list_nodes()), pinned.nodes) << place;
    EXPECT_EQ(hits(Mode::Exact), pinned.exact_hits) << place;
    EXPECT_EQ(hits(Mode::Fast), pinned.fast_hits) << place;
}

// Nodes and exact hits were the same for g++ 12 and clang 14. A change of a scene, a
// builder or of fast mode's arithmetic changes them; exact hits change with the scene or its rays alone.

TEST(Reproducible, NodesAndHitsArePinnedForEveryCompiler) {
    for (const Pinned& pinned : kPinned) expect_pinned(pinned);
}

TEST(Reproducible, NodesAndHitsArePinnedForOneAndTwoThreads) {
    for (const int count : {1, 2}) {
        const ThreadLimit limit(count);
        expect_pinned(kPinned[0]);
        expect_pinned(kPinned[3]);
    }
}

}  // namespace
}  // namespace boxwood
