#include "core/measure/verify.h"

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/bvh/binned_sah.h"
#include "core/refs/whole_boxes.h"
#include "support/random_mesh.h"

namespace boxwood {
namespace {

Structure brute_force(const Mesh& mesh, Task& task) {
    return Structure(BruteForceBuilder().build(mesh, WholeBoxes().make(mesh, task).refs, task));
}

TEST(VerificationRays, AreValidRepeatableAndOftenHit) {
    Scene scene;
    scene.mesh = random_triangles(300, 0.3f, 1);
    const std::vector<Ray> rays = verification_rays(scene, 2000);
    const std::vector<Ray> again = verification_rays(scene, 2000);
    ASSERT_EQ(rays.size(), 2000u);
    Task task;
    const std::vector<Hit> hits =
        closest_hits(brute_force(scene.mesh, task), scene.mesh, rays, Mode::Exact, task);
    size_t hit_count = 0;
    size_t axis_parallel = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        EXPECT_TRUE(is_valid(rays[i]));
        EXPECT_EQ(rays[i].origin, again[i].origin);
        EXPECT_EQ(rays[i].direction, again[i].direction);
        if (hits[i].is_hit()) ++hit_count;
        const Vec3 zero = glm::vec3(glm::equal(rays[i].direction, Vec3(0.0f)));
        if (zero.x + zero.y + zero.z == 2.0f) ++axis_parallel;
    }
    EXPECT_GT(hit_count, 1000u);
    EXPECT_EQ(axis_parallel, 500u);
    EXPECT_TRUE(verification_rays(Scene(), 10).empty());
}

TEST(CompareHits, FindsNothingWhereAStructureIsRight) {
    Scene scene;
    scene.mesh = random_triangles(200, 0.3f, 2);
    Task task;
    const std::vector<Ray> rays = verification_rays(scene, 1000);
    const std::vector<Hit> expected =
        closest_hits(brute_force(scene.mesh, task), scene.mesh, rays, Mode::Exact, task);
    const Structure bvh(BinnedSah().build(scene.mesh, WholeBoxes().make(scene.mesh, task).refs, task));
    EXPECT_EQ(compare_hits(bvh, scene.mesh, rays, expected, Mode::Exact, task).wrong, 0u);
}

TEST(CompareHits, FindsAMissingTriangleAndAChangedBit) {
    Scene scene;
    scene.mesh = random_triangles(200, 0.3f, 3);
    Task task;
    const std::vector<Ray> rays = verification_rays(scene, 1000);
    std::vector<Hit> expected =
        closest_hits(brute_force(scene.mesh, task), scene.mesh, rays, Mode::Exact, task);

    References refs = WholeBoxes().make(scene.mesh, task);
    const size_t seen = static_cast<size_t>(std::ranges::find_if(expected, &Hit::is_hit) - expected.begin());
    std::erase_if(refs.refs, [&](const PrimRef& ref) { return ref.prim == expected[seen].prim; });
    const Structure incomplete(BinnedSah().build(scene.mesh, refs.refs, task));
    const Disagreement missing = compare_hits(incomplete, scene.mesh, rays, expected, Mode::Exact, task);
    EXPECT_GT(missing.wrong, 0u);
    EXPECT_EQ(missing.first, seen);
    EXPECT_NE(missing.found.prim, expected[seen].prim);

    expected[seen].t = std::nextafter(expected[seen].t, 0.0f);
    const Disagreement bit =
        compare_hits(brute_force(scene.mesh, task), scene.mesh, rays, expected, Mode::Exact, task);
    EXPECT_EQ(bit.wrong, 1u);
    EXPECT_EQ(bit.first, seen);
}

}  // namespace
}  // namespace boxwood
