#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/render/color_map.h"
#include "core/render/trace_image.h"
#include "core/scene/camera.h"

namespace boxwood {

/// Where the live CPU ray-traced picture stands.
enum class TracedView : uint8_t {
    Off,
    Beside,  ///< right half of the view, the OpenGL picture on the left; same camera
    Over,    ///< in place of the mesh; boxes and lines are drawn over it
};

/// What the colour of a node box says.
enum class BoxColor : uint8_t {
    Level,       ///< its level, along the colour map
    Primitives,  ///< references below it, logarithmic
    SahShare,    ///< its own share of the SAH cost, logarithmic
    Visits,      ///< how often rays visit it, logarithmic
};

/// Whose visits BoxColor::Visits shows.
enum class VisitRays : uint8_t {
    Picked,   ///< of the picked ray
    Picture,  ///< of all primary rays of the view
};

/// What the lower half of the right panel shows.
enum class SidePanel : uint8_t { Levels, Node, Verify };

enum class Theme : uint8_t { Dark, Light };

enum class UpAxis : uint8_t { X, Y, Z };

/// Levels whose boxes are drawn, both ends included, 0 <= first <= last <= kMaxLevel. What lies beyond the
/// tree's last level means that level.
struct LevelRange {
    static constexpr int kMaxLevel = 999;
    int first = 0;
    int last = 4;

    bool operator==(const LevelRange&) const = default;
};

/// A ray that was picked in the picture, from the eye of that moment on, in world units.
struct PickedRay {
    Vec3 origin{0.0f};
    Vec3 direction{0.0f, 0.0f, 1.0f};

    bool operator==(const PickedRay&) const = default;
};

/// The truth of a session: plain data, of which everything that a frame shows is derived. A default value is
/// what a new session shows.
struct ViewerState {
    std::string scene = "atrium";                         ///< see open_scene; a file as the user named it
    std::string recipe = "evh(t=14) > bvh-binned-sah";    ///< text, see parse_recipe
    Mode mode = Mode::Exact;                              ///< how rays decide intersections
    std::optional<Camera> camera;                         ///< none: the scene's own view, or all of it
    std::array<std::optional<Camera>, 9> stored_views{};  ///< keys 1 to 9
    UpAxis up_axis = UpAxis::Y;                           ///< of orbiting and of whole-scene views

    LevelRange levels;
    bool leaves_above = true;  ///< leaves above levels.first too, so that the picture is whole
    bool show_boxes = true;
    bool show_mesh = true;
    bool show_wire = false;
    bool show_red = true;               ///< subdivided triangles in red
    bool show_reference_boxes = false;  ///< the boxes of subdivided triangles, coloured by primitive
    bool show_shared = false;           ///< triangles of which the builder made more references, in blue
    bool show_empty = false;            ///< empty cells
    bool see_through = false;           ///< boxes through everything in front of them; false: hidden lines
    BoxColor box_color = BoxColor::Level;
    VisitRays visit_rays = VisitRays::Picked;
    bool show_unvisited = false;   ///< where colours say visits: boxes that no ray visited, faint
    std::optional<PickedRay> ray;  ///< drawn as a line

    // Nodes and triangles of what scene and recipe make; another scene or recipe forgets them.
    uint32_t node = kNoIndex;            ///< selected; index into NodeList::nodes
    uint32_t prim = kNoIndex;            ///< selected triangle; index into Mesh::triangles
    std::vector<uint32_t> hidden_nodes;  ///< with all below them, and the triangles in no other leaf
    uint32_t isolated = kNoIndex;        ///< node: only it and what is below it is shown

    SidePanel side = SidePanel::Levels;
    int verify_rays = 0;  ///< rays of the traced view, or the view, to be checked; 0: none asked for

    TracedView traced = TracedView::Off;
    Shading shading = Shading::Primary;      ///< of the traced view
    int spp = 0;                             ///< its samples per pixel, 0 to 4096; 0: the shading's default
    ColorMap color_map = ColorMap::Viridis;  ///< of boxes and of the heat map
    bool log_heat = false;                   ///< logarithmic scale of the heat map
    float heat_max = 0.0f;                   ///< upper end of its scale; 0: from the picture

    Theme theme = Theme::Dark;
    float interface_scale = 1.0f;  ///< 0.5 to 4
    int width = 1280;              ///< of the frame, in pixels, 16 to 8192
    int height = 720;
    bool show_panels = true;
    bool show_times = true;  ///< measured times and rates; without, the frame is the same on every machine
    bool show_keys = false;  ///< the list of all keys over the picture

    bool operator==(const ViewerState&) const = default;
};

/// Unit vector of the axis.
inline Vec3 up_vector(UpAxis axis) {
    return {axis == UpAxis::X ? 1.0f : 0.0f, axis == UpAxis::Y ? 1.0f : 0.0f,
            axis == UpAxis::Z ? 1.0f : 0.0f};
}

}  // namespace boxwood
