#include "bench/embree_peer.h"

#include <algorithm>
#include <atomic>
#include <vector>

#include "core/base/assert.h"

#ifdef BOXWOOD_WITH_EMBREE
#include <embree3/rtcore.h>
#endif

namespace boxwood::bench {

#ifdef BOXWOOD_WITH_EMBREE

namespace {

constexpr EmbreeVariant kVariants[] = {
    {"embree:high", ""},
    {"embree:high-avx2", "isa=avx2"},
    {"embree:high-avx2-splits2", "isa=avx2,max_spatial_split_replications=2"},
    {"embree:high-robust", "", EmbreeQuality::High, /*robust=*/true},
    {"embree:low", "", EmbreeQuality::Low, /*robust=*/false, /*by_default=*/false},
    {"embree:medium", "", EmbreeQuality::Medium, /*robust=*/false, /*by_default=*/false},
};
constexpr EmbreeVariant kBuilds[] = {
    {"embree:low", "", EmbreeQuality::Low},
    {"embree:medium", "", EmbreeQuality::Medium},
    {"embree:high", "", EmbreeQuality::High},
};
constexpr size_t kPacket = 16;

RTCBuildQuality quality_of(const EmbreeVariant& variant) {
    switch (variant.quality) {
        case EmbreeQuality::Low:
            return RTC_BUILD_QUALITY_LOW;
        case EmbreeQuality::Medium:
            return RTC_BUILD_QUALITY_MEDIUM;
        case EmbreeQuality::High:
            break;
    }
    return RTC_BUILD_QUALITY_HIGH;
}

RTCRay to_embree(const Ray& ray) {
    RTCRay r;
    r.org_x = ray.origin.x;
    r.org_y = ray.origin.y;
    r.org_z = ray.origin.z;
    r.tnear = ray.t_min;
    r.dir_x = ray.direction.x;
    r.dir_y = ray.direction.y;
    r.dir_z = ray.direction.z;
    r.time = 0.0f;
    r.tfar = ray.t_max;
    r.mask = ~0u;
    r.id = 0;
    r.flags = 0;
    return r;
}

Hit hit_of(float t, unsigned geometry, unsigned prim) {
    return geometry == RTC_INVALID_GEOMETRY_ID ? Hit{} : Hit{t, prim};
}

RTCIntersectContext context_with(RTCIntersectContextFlags flags) {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags;
    return context;
}

}  // namespace

struct EmbreeScene::Impl {
    Array<Vec3> positions;  ///< one more than the mesh's: Embree reads 16 bytes at each
    std::atomic<int64_t> byte_count{0};
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;

    ~Impl() {
        rtcReleaseScene(scene);
        rtcReleaseDevice(device);
    }

    static bool watch_memory(void* self, ssize_t bytes, bool /*after*/) {
        static_cast<Impl*>(self)->byte_count += bytes;
        return true;
    }

    void open(const Mesh& mesh, const EmbreeVariant& variant) {
        device = rtcNewDevice(variant.config);
        BOXWOOD_ASSERT(device != nullptr);
        rtcSetDeviceMemoryMonitorFunction(device, watch_memory, this);
        RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(),
                                   0, sizeof(Vec3), mesh.positions.size());
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                   mesh.triangles.data(), 0, sizeof(UVec3), mesh.triangles.size());
        rtcSetGeometryBuildQuality(geometry, quality_of(variant));
        rtcCommitGeometry(geometry);
        scene = rtcNewScene(device);
        rtcSetSceneBuildQuality(scene, quality_of(variant));
        rtcSetSceneFlags(scene, variant.robust ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
        rtcAttachGeometry(scene, geometry);
        rtcReleaseGeometry(geometry);
    }
};

std::span<const EmbreeVariant> embree_variants() { return kVariants; }
std::span<const EmbreeVariant> embree_builds() { return kBuilds; }
bool has_embree() { return true; }
std::string embree_version() { return RTC_VERSION_STRING; }

EmbreeScene::EmbreeScene(const Mesh& mesh, const EmbreeVariant& variant) : impl_(std::make_unique<Impl>()) {
    impl_->positions = mesh.positions;
    impl_->positions.emplace_back(0.0f);
    impl_->open(mesh, variant);
}

void EmbreeScene::build() { rtcCommitScene(impl_->scene); }

void EmbreeScene::closest_hits(std::span<const Ray> rays, std::span<Hit> hits) const {
    RTCIntersectContext context = context_with(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    for (size_t i = 0; i < rays.size(); ++i) {
        RTCRayHit query;
        query.ray = to_embree(rays[i]);
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(impl_->scene, &context, &query);
        hits[i] = hit_of(query.ray.tfar, query.hit.geomID, query.hit.primID);
    }
}

void EmbreeScene::closest_hits_in_packets(std::span<const Ray> rays, std::span<Hit> hits) const {
    RTCIntersectContext context = context_with(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    for (size_t begin = 0; begin < rays.size(); begin += kPacket) {
        const size_t count = std::min(kPacket, rays.size() - begin);
        alignas(64) int valid[kPacket];
        RTCRayHit16 query;
        for (size_t k = 0; k < kPacket; ++k) {
            valid[k] = k < count ? -1 : 0;
            const Ray& ray = rays[begin + std::min(k, count - 1)];
            query.ray.org_x[k] = ray.origin.x;
            query.ray.org_y[k] = ray.origin.y;
            query.ray.org_z[k] = ray.origin.z;
            query.ray.tnear[k] = ray.t_min;
            query.ray.dir_x[k] = ray.direction.x;
            query.ray.dir_y[k] = ray.direction.y;
            query.ray.dir_z[k] = ray.direction.z;
            query.ray.time[k] = 0.0f;
            query.ray.tfar[k] = ray.t_max;
            query.ray.mask[k] = ~0u;
            query.ray.id[k] = 0;
            query.ray.flags[k] = 0;
            query.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
            query.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
        }
        rtcIntersect16(valid, impl_->scene, &context, &query);
        for (size_t k = 0; k < count; ++k)
            hits[begin + k] = hit_of(query.ray.tfar[k], query.hit.geomID[k], query.hit.primID[k]);
    }
}

void EmbreeScene::any_hits(std::span<const Ray> rays, std::span<uint8_t> occluded) const {
    RTCIntersectContext context = context_with(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    for (size_t i = 0; i < rays.size(); ++i) {
        RTCRay ray = to_embree(rays[i]);
        rtcOccluded1(impl_->scene, &context, &ray);
        occluded[i] = ray.tfar < 0.0f ? 1 : 0;  // -infinity where anything is hit
    }
}

uint64_t EmbreeScene::byte_count() const {
    return static_cast<uint64_t>(std::max<int64_t>(impl_->byte_count.load(), 0));
}

#else

struct EmbreeScene::Impl {};

std::span<const EmbreeVariant> embree_variants() { return {}; }
std::span<const EmbreeVariant> embree_builds() { return {}; }
bool has_embree() { return false; }
std::string embree_version() { return {}; }

EmbreeScene::EmbreeScene(const Mesh& /*mesh*/, const EmbreeVariant& /*variant*/) {
    BOXWOOD_ASSERT(has_embree());
}
void EmbreeScene::build() {}
void EmbreeScene::closest_hits(std::span<const Ray> /*rays*/, std::span<Hit> /*hits*/) const {}
void EmbreeScene::closest_hits_in_packets(std::span<const Ray> /*rays*/, std::span<Hit> /*hits*/) const {}
void EmbreeScene::any_hits(std::span<const Ray> /*rays*/, std::span<uint8_t> /*occluded*/) const {}
uint64_t EmbreeScene::byte_count() const { return 0; }

#endif

EmbreeScene::~EmbreeScene() = default;
EmbreeScene::EmbreeScene(EmbreeScene&&) noexcept = default;
EmbreeScene& EmbreeScene::operator=(EmbreeScene&&) noexcept = default;

}  // namespace boxwood::bench
