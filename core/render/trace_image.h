#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "core/base/ray.h"
#include "core/base/task.h"
#include "core/render/color_map.h"
#include "core/render/image.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "core/structure/structure.h"

namespace boxwood {

/// What a pixel shows.
enum class Shading : uint8_t {
    Primary,    ///< base colour under a light at the eye, fading with depth; both sides
    Normals,    ///< geometric normal towards the eye, (n + 1) / 2
    Ao,         ///< share of the hemisphere that is open within a radius
    Heat,       ///< nodes that the primary ray visits
    HeatTests,  ///< primitives that the primary ray tests
    HeatExact,  ///< decisions of the primary ray that were left to exact arithmetic
};

/// By value of Shading.
inline constexpr std::array<const char*, 6> kShadingNames = {"primary", "normals",    "ao",
                                                             "heat",    "heat-tests", "heat-exact"};

std::optional<Shading> find_shading(const std::string& name);

/// Whether pixels are counts under a colour map.
inline bool is_heat(Shading shading) { return shading >= Shading::Heat; }

/// What a heat shading shows of a ray's counts.
inline uint64_t heat_count(const Count& count, Shading shading) {
    return shading == Shading::Heat ? count.nodes : shading == Shading::HeatTests ? count.tests : count.exact;
}

/// All that decides what a traced picture looks like.
struct TraceSettings {
    Camera camera;
    int width = 1280;  ///< pixels, 1 or more
    int height = 720;
    Shading shading = Shading::Primary;
    Mode mode = Mode::Exact;
    int spp = 0;              ///< samples per pixel; 0: default_spp. Sample 0 goes through the pixel's centre
    int ao_rays = 4;          ///< hemisphere rays of each sample, 1 to 64
    float ao_radius = 0.05f;  ///< relative to the diagonal of the scene's box, above 0
    ColorMap color_map = ColorMap::Viridis;      ///< heat
    bool log_heat = false;                       ///< heat: logarithmic instead of linear scale
    double heat_max = 0.0;                       ///< heat: upper end of the scale; 0: from the picture
    Vec3 background{0.0331f, 0.0382f, 0.0467f};  ///< linear RGB, where nothing is hit
    bool measure = false;                        ///< count nodes and tests in a pass apart

    bool operator==(const TraceSettings&) const = default;
};

/// Samples per pixel for a picture to look at: 4, for `ao` 16, for heat 1.
int default_spp(Shading shading);

/// settings.spp, or the shading's default where that is 0.
int sample_count(const TraceSettings& settings);

/// Scale of a heat map: its upper end is the 99.5th percentile of the picture, so that a few costly pixels do
/// not darken the rest.
struct HeatScale {
    ValueScale scale;
    double largest = 0.0;  ///< largest value of the picture, which may be beyond the scale
};

/// A traced picture and what it cost.
struct TraceResult {
    Image image;
    uint64_t ray_count = 0;     ///< rays of the picture
    double ms = 0.0;            ///< time for them, not counting passes; 0 for heat without `measure`
    Count counters;             ///< of `counted_rays` primary rays: all of heat; otherwise with `measure`
    uint64_t counted_rays = 0;  ///< through the pixel centres
    HeatScale heat;             ///< for heat shadings
    bool stopped = false;       ///< task.stop was requested: the picture is not to be used
};

/// Traces the whole picture on all threads of parallel.h. The same bits for any number of threads and any
/// exact structure. With settings.measure there are two passes, one timed and one counted. A scene without
/// triangles gives the background. task.done counts pixels.
TraceResult trace_image(const Scene& scene, const Structure& structure, const TraceSettings& settings,
                        Task& task);

}  // namespace boxwood
