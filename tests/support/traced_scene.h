#pragma once

#include <memory>
#include <vector>

#include "core/base/rng.h"
#include "core/brute_force/brute_force.h"
#include "core/bvh/binned_sah.h"
#include "core/render/trace_image.h"

namespace boxwood {

/// A scene of the given triangles, one object for each.
inline std::shared_ptr<Scene> scene_of(const std::vector<Triangle>& triangles,
                                       const Vec3& base_color = Vec3(0.8f)) {
    auto scene = std::make_shared<Scene>();
    Mesh& mesh = scene->mesh;
    for (const Triangle& t : triangles) {
        const uint32_t first = static_cast<uint32_t>(mesh.positions.size());
        mesh.triangles.push_back(UVec3(first, first + 1, first + 2));
        mesh.source_prim.push_back(first / 3);
        mesh.object.push_back(0);
        for (const Vec3& corner : {t.a, t.b, t.c}) mesh.positions.push_back(corner);
    }
    mesh.objects.push_back({"all", base_color});
    return scene;
}

/// A parallelogram as two triangles.
inline void add_quad(std::vector<Triangle>& triangles, const Vec3& corner, const Vec3& u, const Vec3& v) {
    triangles.push_back({corner, corner + u, corner + u + v});
    triangles.push_back({corner, corner + u + v, corner + v});
}

/// Triangles at random in the cube [-1, 1]^3.
inline std::shared_ptr<Scene> random_scene(uint32_t count, float size) {
    std::vector<Triangle> triangles;
    Rng rng(3);
    const auto point = [&rng](float extent) {
        const float x = rng.next(-extent, extent), y = rng.next(-extent, extent),
                    z = rng.next(-extent, extent);
        return Vec3(x, y, z);
    };
    for (uint32_t i = 0; i < count; ++i) {
        const Vec3 center = point(1.0f), a = point(size), b = point(size), c = point(size);
        triangles.push_back({center + a, center + b, center + c});
    }
    return scene_of(triangles);
}

template <class Method>
Structure structure_by(const Method& method, const Scene& scene) {
    std::vector<PrimRef> refs;
    for (uint32_t i = 0; i < scene.mesh.triangle_count(); ++i)
        refs.push_back({scene.mesh.triangle(i).bounds(), i});
    Task task;
    return Structure(method.build(scene.mesh, refs, task));
}

/// From (0, 0, 3) towards the origin.
inline TraceSettings settings_of(int width, int height, Shading shading, int spp) {
    TraceSettings settings;
    settings.camera = {.eye = Vec3(0.0f, 0.0f, 3.0f), .target = Vec3(0.0f)};
    settings.width = width;
    settings.height = height;
    settings.shading = shading;
    settings.spp = spp;
    return settings;
}

inline constexpr Shading kAllShadings[] = {Shading::Primary, Shading::Normals, Shading::Ao, Shading::Heat,
                                           Shading::HeatTests};

}  // namespace boxwood
