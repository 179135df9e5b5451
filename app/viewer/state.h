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

/// One of the two recipes that a window can show against each other.
enum class Side : uint8_t { A, B };
inline constexpr std::array<Side, 2> kSides{Side::A, Side::B};
inline constexpr size_t index_of(Side side) { return static_cast<size_t>(side); }
inline constexpr Side other_side(Side side) { return side == Side::A ? Side::B : Side::A; }

/// How two recipes share the view; the camera is the same for both.
enum class CompareView : uint8_t {
    Wipe,    ///< one picture, A to the left of a bar, B to the right of it
    Beside,  ///< a picture each, A on the left
};

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

/// What belongs to one recipe. Nodes are those of what scene and recipe make; another scene or recipe forgets
/// them.
struct SideState {
    std::string recipe;                    ///< text, see parse_recipe; of B: empty where nothing is compared
    uint32_t node = kNoIndex;              ///< selected; index into NodeList::nodes
    std::vector<uint32_t> hidden_nodes{};  ///< with all below them, and the triangles in no other leaf
    uint32_t isolated = kNoIndex;          ///< node: only it and what is below it is shown

    bool operator==(const SideState&) const = default;
    bool has_nodes() const { return node != kNoIndex || isolated != kNoIndex || !hidden_nodes.empty(); }
};

/// The truth of a session: plain data, of which everything that a frame shows is derived. A default value is
/// what a new session shows.
struct ViewerState {
    std::string scene = "atrium";  ///< see open_scene; a file as the user named it
    std::array<SideState, 2> sides{SideState{.recipe = "evh(t=14) > bvh-binned-sah"}, SideState{}};
    Side active = Side::A;  ///< that panels and keys edit, where two are compared
    CompareView compare_view = CompareView::Wipe;
    float wipe = 0.5f;                                    ///< place of the bar, 0 to 1 of the picture's width
    bool heat_difference = false;                         ///< a heat map of two recipes shows A - B
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

    uint32_t prim = kNoIndex;  ///< selected triangle; index into Mesh::triangles; forgotten with the nodes

    SidePanel side_panel = SidePanel::Levels;
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

    /// Two recipes are shown.
    bool compares() const { return !sides[1].recipe.empty(); }
    bool has(Side which) const { return which == Side::A || compares(); }
    Side active_side() const { return compares() ? active : Side::A; }
    /// Of the side that panels and keys edit.
    SideState& side() { return sides[index_of(active_side())]; }
    const SideState& side() const { return sides[index_of(active_side())]; }
    const SideState& side(Side which) const { return sides[index_of(which)]; }
    /// The heat map shows A - B.
    bool shows_difference() const {
        return compares() && heat_difference && traced != TracedView::Off && is_heat(shading);
    }

    bool operator==(const ViewerState&) const = default;
};

/// Unit vector of the axis.
inline Vec3 up_vector(UpAxis axis) {
    return {axis == UpAxis::X ? 1.0f : 0.0f, axis == UpAxis::Y ? 1.0f : 0.0f,
            axis == UpAxis::Z ? 1.0f : 0.0f};
}

}  // namespace boxwood
