#include "app/viewer/visits.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/catalog/pipeline.h"

namespace boxwood {
namespace {

constexpr size_t kBatch = 64;  // rays between two looks at the task

}  // namespace

Ray ray_of(const PickedRay& picked) {
    Ray ray;
    ray.origin = picked.origin;
    ray.direction = picked.direction;
    return ray;
}

Visits count_visits(const Built& built, std::span<const Ray> rays, Mode mode, Task& task) {
    const size_t node_count = built.levels->list.nodes.size();
    const size_t strips = std::clamp(rays.size() / kBatch, size_t{1}, static_cast<size_t>(thread_count()));
    std::vector<std::vector<uint32_t>> parts(strips);
    task.done = 0;
    task.total = rays.size();
    parallel_for(strips, 1, [&](size_t first_strip, size_t end_strip) {
        for (size_t strip = first_strip; strip < end_strip; ++strip) {
            parts[strip].assign(node_count, 0);
            const size_t strip_end = rays.size() * (strip + 1) / strips;
            for (size_t begin = rays.size() * strip / strips; begin < strip_end && !task.stopped();) {
                const size_t count = std::min(kBatch, strip_end - begin);
                built.structure.add_visits(built.scene->mesh, rays.subspan(begin, count), parts[strip], mode,
                                           task);
                begin += count;
                task.done += count;
            }
        }
    });
    Visits visits;
    visits.ray_count = rays.size();
    visits.by_node = std::move(parts[0]);
    for (size_t strip = 1; strip < strips; ++strip)
        for (size_t node = 0; node < node_count; ++node) visits.by_node[node] += parts[strip][node];
    for (const uint32_t count : visits.by_node) {
        visits.most = std::max(visits.most, count);
        visits.visited_nodes += count > 0 ? 1 : 0;
    }
    return visits;
}

std::vector<Ray> picture_rays(const Camera& camera, int width, int height) {
    std::vector<Ray> rays;
    const CameraFrame frame = camera_frame(camera, static_cast<double>(width) / height);
    rays.reserve(static_cast<size_t>(width) * static_cast<size_t>(height));
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) rays.push_back(camera_ray(frame, x + 0.5, y + 0.5, width, height));
    return rays;
}

}  // namespace boxwood
