#include <gtest/gtest.h>

#include "core/bvh/binned_sah.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/wide_bvh/collapse.h"
#include "core/wide_bvh/plain_hits.h"
#include "support/random_mesh.h"
#include "support/simd_targets.h"

namespace boxwood {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr size_t kPacket = 16;

/// Blocks of 4 x 4 pixels of a square picture.
void add_blocks(const Camera& camera, int size, std::vector<Ray>& rays) {
    const CameraFrame frame = camera_frame(camera, 1.0);
    for (int top = 0; top < size; top += 4)
        for (int left = 0; left < size; left += 4)
            for (int i = 0; i < 16; ++i)
                rays.push_back(camera_ray(frame, left + i % 4 + 0.5, top + i / 4 + 0.5, size, size));
}

/// Packets of rays from one origin, through a scene's vertices or just past them: wide and narrow ones, from
/// outside and from vertices; of some packets single rays that packets have no room for: of another octant,
/// with zeros, not valid, or from another origin.
void add_packets(const Mesh& mesh, const Box& box, std::vector<Ray>& rays) {
    Rng rng(1);
    const auto vertex = [&] { return mesh.positions[rng.next_index(mesh.positions.size())]; };
    const Vec3 center = 0.5f * (box.lower + box.upper);
    const float size = glm::length(box.upper - box.lower);
    for (int packet = 0; packet < 120; ++packet) {
        const Vec3 origin = packet % 4 == 0 ? vertex() : center + random_point(rng, 0.7f * size);
        const Vec3 target = vertex();
        const float spread = packet % 3 == 0 ? 0.0f : packet % 3 == 1 ? 1e-3f * size : 0.05f * size;
        for (size_t i = 0; i < kPacket; ++i) {
            Ray ray;
            ray.origin = origin;
            ray.direction = target + random_point(rng, spread) - origin;
            if (packet % 7 == 0) ray.direction[packet % 3] *= 0.0f;
            if (packet % 11 == 0) ray.direction[packet % 3] *= 0x1p-60f;
            if (packet % 13 == 0) ray.t_max = 1.0f;
            if (packet % 17 == 0) ray.t_min = 1.0f;
            if (packet % 29 == 0) ray.t_min = 0.25f * static_cast<float>(i % 5);
            if (i == 5 && packet % 5 == 0) ray.direction[packet % 3] *= -1.0f;
            if (i == 6 && packet % 19 == 0) ray.direction *= 0x1p-100f;
            if (i == 7 && packet % 23 == 0) ray.origin *= 1.5f;
            if (i == 8 && packet % 31 == 0) ray.direction = Vec3(0.0f);
            if (i == 9 && packet % 37 == 0) ray.origin.y = kInfinity;
            if (i == 10 && packet % 41 == 0) ray.direction.z = std::numeric_limits<float>::quiet_NaN();
            if (i == 11 && packet % 43 == 0) ray.t_min = 2.0f * (ray.t_max = 1.0f);
            rays.push_back(ray);
        }
    }
}

std::vector<Ray> rays_of(const Scene& scene) {
    const Box box = scene.mesh.bounds();
    Camera camera = scene.camera.value_or(fit_camera(box));
    std::vector<Ray> rays;
    add_blocks(camera, 64, rays);
    camera.orthographic = true;
    add_blocks(camera, 16, rays);
    // Along an axis: the picture's middle has directions of all signs and of both sizes next to zero.
    Camera along;
    along.eye = box.upper + (box.upper - box.lower);
    along.target = along.eye - Vec3(0.0f, 0.0f, 1.0f);
    along.eye.x = along.target.x = 0.5f * (box.lower.x + box.upper.x);
    along.eye.y = along.target.y = 0.5f * (box.lower.y + box.upper.y);
    along.fov = 30.0f;
    add_blocks(along, 28, rays);
    add_packets(scene.mesh, box, rays);
    rays.resize(rays.size() - 5);  // the last packet is not whole
    return rays;
}

template <Mode mode, uint32_t Width>
void expect_plain_hits(const WideBvh<Width>& bvh, const Mesh& mesh, const std::vector<Ray>& rays) {
    const Task task;
    std::vector<Hit> expected(rays.size());
    for (size_t i = 0; i < rays.size(); ++i) expected[i] = plain_closest_hit<mode>(bvh, mesh, rays[i], task);
    for_each_target(HWY_TARGETS, [&](const SimdTarget& target) {
        std::vector<Hit> hits(rays.size(), Hit{-1.0f, 1});
        bvh.closest_hits_coherent(mesh, rays, hits, mode, task);
        for (size_t i = 0; i < rays.size(); ++i) {
            ASSERT_EQ(std::bit_cast<uint32_t>(hits[i].t), std::bit_cast<uint32_t>(expected[i].t))
                << target.name() << ", ray " << i;
            ASSERT_EQ(hits[i].prim, expected[i].prim) << target.name() << ", ray " << i;
        }
    });
}

class PacketTracer : public testing::TestWithParam<const char*> {};

TEST_P(PacketTracer, FindsThePlainTracersHitsWithEveryInstructionSet) {
    Task task;
    const auto scene = open_scene(GetParam(), task);
    const Mesh& mesh = scene->mesh;
    const std::vector<Ray> rays = rays_of(*scene);
    const Bvh2 bvh = BinnedSah{}.build(mesh, whole_refs(mesh), task);
    const WideBvh<4> four = Collapse<4>{}.apply(mesh, {}, bvh, task);
    const WideBvh<8> eight = Collapse<8>{}.apply(mesh, {}, bvh, task);
    const WideBvh<16> sixteen = Collapse<16>{}.apply(mesh, {}, bvh, task);
    expect_plain_hits<Mode::Exact>(four, mesh, rays);
    expect_plain_hits<Mode::Fast>(four, mesh, rays);
    expect_plain_hits<Mode::Exact>(eight, mesh, rays);
    expect_plain_hits<Mode::Fast>(eight, mesh, rays);
    expect_plain_hits<Mode::Exact>(sixteen, mesh, rays);
    expect_plain_hits<Mode::Fast>(sixteen, mesh, rays);
}

INSTANTIATE_TEST_SUITE_P(Scenes, PacketTracer, testing::Values("atrium", "spaceship", "cornell"));

/// Each triangle three times: every hit is a tie, which the lowest primitive wins.
TEST(PacketTracer, LowestOfCoincidentTrianglesWins) {
    Task task;
    Scene scene;
    scene.mesh = random_triangles(200, 0.4f, 3);
    const Array<UVec3> once = scene.mesh.triangles;
    for (int copy = 0; copy < 2; ++copy) {
        for (size_t i = once.size(); i-- > 0;) {
            scene.mesh.source_prim.push_back(static_cast<uint32_t>(scene.mesh.triangle_count()));
            scene.mesh.object.push_back(0);
            scene.mesh.triangles.push_back(once[i]);
        }
    }
    const std::vector<Ray> rays = rays_of(scene);
    const Bvh2 bvh = BinnedSah{}.build(scene.mesh, whole_refs(scene.mesh), task);
    expect_plain_hits<Mode::Exact>(Collapse<8>{}.apply(scene.mesh, {}, bvh, task), scene.mesh, rays);
}

TEST(PacketTracer, AnEmptyMeshIsMissed) {
    expect_plain_hits<Mode::Exact>(WideBvh<8>{}, Mesh{}, std::vector<Ray>(40));
}

TEST(PacketTracer, StopsWhenAsked) {
    std::stop_source stop;
    const Task task(stop.get_token());
    Task building;
    const Mesh mesh = random_triangles(50, 0.4f, 4);
    const WideBvh<8> bvh =
        Collapse<8>{}.apply(mesh, {}, BinnedSah{}.build(mesh, whole_refs(mesh), building), building);
    const std::vector<Ray> rays(1 << 16, Ray{Vec3(0.0f, 0.0f, -10.0f)});
    std::vector<Hit> hits(rays.size());
    stop.request_stop();
    bvh.closest_hits_coherent(mesh, rays, hits, Mode::Exact, task);
    EXPECT_FALSE(hits.back().is_hit());
}

}  // namespace
}  // namespace boxwood
