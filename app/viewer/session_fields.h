#pragma once

#include <array>
#include <string_view>

#include "app/viewer/session.h"

namespace boxwood {

inline constexpr std::array<const char*, 2> kModeNames{"exact", "fast"};
inline constexpr std::array<const char*, 2> kSideNames{"a", "b"};
inline constexpr std::array<const char*, 2> kCompareViewNames{"wipe", "beside"};
inline constexpr std::array<const char*, 3> kTracedViewNames{"off", "beside", "over"};
inline constexpr std::array<const char*, 4> kBoxColorNames{"level", "primitives", "sah-share", "visits"};
inline constexpr std::array<const char*, 2> kVisitRaysNames{"picked", "picture"};
inline constexpr std::array<const char*, 3> kSidePanelNames{"levels", "node", "verify"};
inline constexpr std::array<const char*, 2> kThemeNames{"dark", "light"};
inline constexpr std::array<const char*, 3> kUpAxisNames{"x", "y", "z"};

/// No picture has more.
inline constexpr int kMostVerifyRays = 8192 * 8192;

/// Walks the fields of a session in the order in which they are printed: the reader and the writer are
/// visitors. `defaults` has the same fields with their default values.
template <class Visitor>
void describe_session(Visitor& v, Session& session, const Session& defaults) {
    ViewerState& s = session.state;
    const ViewerState& d = defaults.state;
    v.scene("scene", s.scene, d.scene);
    SideState &a = s.sides[0], &b = s.sides[1];
    v.text("recipe", a.recipe, d.side(Side::A).recipe);
    v.text("recipe_b", b.recipe, d.side(Side::B).recipe);
    v.choice("active", s.active, d.active, kSideNames);
    v.choice("compare", s.compare_view, d.compare_view, kCompareViewNames);
    v.number("wipe", s.wipe, d.wipe, 0.0f, 1.0f);
    v.flag("difference", s.heat_difference, d.heat_difference);
    v.choice("mode", s.mode, d.mode, kModeNames);
    v.camera("camera", s.camera);
    v.views("views", s.stored_views);
    v.choice("up", s.up_axis, d.up_axis, kUpAxisNames);
    v.levels("levels", s.levels, d.levels);
    v.flag("leaves_above", s.leaves_above, d.leaves_above);
    v.flag("boxes", s.show_boxes, d.show_boxes);
    v.flag("mesh", s.show_mesh, d.show_mesh);
    v.flag("wire", s.show_wire, d.show_wire);
    v.flag("red", s.show_red, d.show_red);
    v.flag("reference_boxes", s.show_reference_boxes, d.show_reference_boxes);
    v.flag("shared", s.show_shared, d.show_shared);
    v.flag("empty_cells", s.show_empty, d.show_empty);
    v.flag("see_through", s.see_through, d.see_through);
    v.choice("box_color", s.box_color, d.box_color, kBoxColorNames);
    v.choice("visit_rays", s.visit_rays, d.visit_rays, kVisitRaysNames);
    v.flag("unvisited", s.show_unvisited, d.show_unvisited);
    v.ray("ray", s.ray);
    v.index("node", a.node);
    v.index("triangle", s.prim);
    v.indices("hidden", a.hidden_nodes);
    v.index("isolated", a.isolated);
    v.index("node_b", b.node);
    v.indices("hidden_b", b.hidden_nodes);
    v.index("isolated_b", b.isolated);
    v.choice("side", s.side_panel, d.side_panel, kSidePanelNames);
    v.whole_number("verify_rays", s.verify_rays, d.verify_rays, 0, kMostVerifyRays);
    v.choice("traced", s.traced, d.traced, kTracedViewNames);
    v.choice("shade", s.shading, d.shading, kShadingNames);
    v.whole_number("spp", s.spp, d.spp, 0, 4096);
    v.choice("color_map", s.color_map, d.color_map, kColorMapNames);
    v.flag("log_heat", s.log_heat, d.log_heat);
    v.number("heat_max", s.heat_max, d.heat_max, 0.0f, 1e6f);
    v.choice("theme", s.theme, d.theme, kThemeNames);
    v.number("scale", s.interface_scale, d.interface_scale, 0.5f, 4.0f);
    v.size("size", s.width, s.height, d.width, d.height);
    v.flag("panels", s.show_panels, d.show_panels);
    v.flag("times", s.show_times, d.show_times);
    v.flag("keys", s.show_keys, d.show_keys);
    v.limits("check", session.limits, defaults.limits);
}

}  // namespace boxwood
