#include "core/render/pixel_tracer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/sampling.h"
#include "core/structure/leaving_ray.h"

namespace boxwood {

namespace {

/// Share of the light that comes from everywhere, so that faces seen edge-on do not turn black.
constexpr double kAmbient = 0.15;
/// Light that is lost at great depth, and the depth at which half of that is lost, relative to the diagonal
/// of the scene's box: tells near from far where the angles are the same.
constexpr double kFade = 0.35;
constexpr double kFadeLength = 0.2;
/// What is lit by the whole hemisphere.
constexpr float kAoWhite = 0.85f;

DVec3 unit_direction(const Ray& ray) {
    const DVec3 d(ray.direction);
    return d / std::sqrt(glm::dot(d, d));
}

}  // namespace

PixelTracer::PixelTracer(const Mesh& mesh, const Box& bounds, Structure structure,
                         const TraceSettings& settings)
    : mesh_(mesh),
      structure_(std::move(structure)),
      settings_(settings),
      frame_(camera_frame(settings.camera, static_cast<double>(settings.width) / settings.height)),
      raster_(frame_, settings.width, settings.height),
      bounds_(bounds),
      diagonal_(std::sqrt(glm::dot(bounds.extent(), bounds.extent()))) {}

void PixelTracer::make_rays(uint32_t sample, std::span<const uint32_t> pixels, std::vector<Ray>& rays) const {
    rays.resize(pixels.size());
    if (sample == 0) return raster_.rays_through(pixels, rays);
    const uint32_t width = static_cast<uint32_t>(settings_.width);
    for (size_t i = 0; i < pixels.size(); ++i) {
        const Vec2 offset = pixel_offset(pixels[i], sample);
        const double x = static_cast<double>(pixels[i] % width) + static_cast<double>(offset.x);
        const double y = static_cast<double>(pixels[i] / width) + static_cast<double>(offset.y);
        rays[i] = camera_ray(frame_, x, y, settings_.width, settings_.height);
    }
}

bool PixelTracer::cast(uint32_t sample, PixelBatch& batch, bool counted, const Task& task) const {
    batch.hits.resize(batch.pixels.size());
    batch.counts.resize(counted ? batch.pixels.size() : 0);
    batch.colors.clear();
    batch.ao_rays.clear();
    if (!counted) return find_hits(sample, batch.pixels, batch.rays, batch.hits, task);
    make_rays(sample, batch.pixels, batch.rays);
    structure_.closest_hits_counted(mesh_, batch.rays, batch.hits, batch.counts, settings_.mode, task);
    return !task.stopped();
}

bool PixelTracer::find_hits(uint32_t sample, std::span<const uint32_t> pixels, std::vector<Ray>& rays,
                            std::span<Hit> hits, const Task& task) const {
    make_rays(sample, pixels, rays);
    structure_.closest_hits_coherent(mesh_, rays, hits, settings_.mode, task);
    return !task.stopped();
}

bool PixelTracer::shade(uint32_t sample, PixelBatch& batch, const Task& task) const {
    if (is_heat(settings_.shading)) return true;
    batch.colors.resize(batch.pixels.size());
    if (settings_.shading == Shading::Ao) return shade_ao(sample, batch, task);
    for (size_t i = 0; i < batch.pixels.size(); ++i) {
        const Hit& hit = batch.hits[i];
        batch.colors[i] = hit.is_hit() ? surface_color(batch.rays[i], hit) : settings_.background;
    }
    return true;
}

Vec3 PixelTracer::surface_color(const Ray& ray, const Hit& hit) const {
    const DVec3 direction = unit_direction(ray);
    const DVec3 normal = facing_normal(mesh_.triangle(hit.prim), direction);
    if (settings_.shading == Shading::Normals) return linear_from_srgb(Vec3(normal * 0.5 + 0.5));
    const double cosine = -glm::dot(normal, direction);
    // Steeper than the cosine alone: a light at the eye gives a flat picture, as nothing is in shadow.
    const double light = kAmbient + (1.0 - kAmbient) * cosine * 0.5 * (1.0 + cosine);
    const double fade = 1.0 - kFade + kFade / (1.0 + depth_in_scene(ray, hit.t) / (kFadeLength * diagonal_));
    return mesh_.base_color(hit.prim) * static_cast<float>(light * fade);
}

/// Distance along the ray from where it enters the scene's box (or begins inside it) to the hit.
double PixelTracer::depth_in_scene(const Ray& ray, float t) const {
    double entry = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        const double d = static_cast<double>(ray.direction[axis]);
        if (d == 0.0) continue;
        const float plane = d > 0.0 ? bounds_.lower[axis] : bounds_.upper[axis];
        entry = std::max(entry, (static_cast<double>(plane) - static_cast<double>(ray.origin[axis])) / d);
    }
    const DVec3 d(ray.direction);
    return std::max(0.0, static_cast<double>(t) - entry) * std::sqrt(glm::dot(d, d));
}

bool PixelTracer::shade_ao(uint32_t sample, PixelBatch& batch, const Task& task) const {
    const uint32_t rays_each = static_cast<uint32_t>(settings_.ao_rays);
    const double radius = static_cast<double>(settings_.ao_radius) * diagonal_;
    batch.ao_owners.clear();
    for (size_t i = 0; i < batch.pixels.size(); ++i) {
        const Hit& hit = batch.hits[i];
        if (!hit.is_hit()) continue;
        const DVec3 normal = facing_normal(mesh_.triangle(hit.prim), unit_direction(batch.rays[i]));
        for (uint32_t k = 0; k < rays_each; ++k) {
            const Vec2 point = sequence_point(batch.pixels[i], sample * rays_each + k, 1);
            const DVec3 direction = cosine_direction(normal, point);
            Ray leaving = leaving_ray(batch.rays[i], hit, normal, direction);
            leaving.t_max = static_cast<float>(radius);
            batch.ao_rays.push_back(leaving);
            batch.ao_owners.push_back(static_cast<uint32_t>(i));
        }
    }
    batch.occluded.resize(batch.ao_rays.size());
    structure_.any_hits(mesh_, batch.ao_rays, batch.occluded, settings_.mode, task);
    if (task.stopped()) return false;

    for (size_t i = 0; i < batch.pixels.size(); ++i)
        batch.colors[i] = batch.hits[i].is_hit() ? Vec3(0.0f) : settings_.background;
    const float share = kAoWhite / static_cast<float>(rays_each);
    for (size_t k = 0; k < batch.ao_rays.size(); ++k)
        if (batch.occluded[k] == 0) batch.colors[batch.ao_owners[k]] += share;
    return true;
}

}  // namespace boxwood
