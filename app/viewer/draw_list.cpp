#include "app/viewer/draw_list.h"

#include <algorithm>

#include "core/render/image.h"

namespace boxwood {
namespace {

constexpr float kLineWidth = 1.4f, kLineCasing = 1.2f, kWireWidth = 1.1f;  // pixels at interface scale 1

constexpr float kDepthFade = 0.5f, kSizeFade = 0.75f;

/// The part of the colour map that stands out from the background.
struct MapPart {
    float from, to;
};
constexpr MapPart kDarkPart = {0.28f, 1.0f};
constexpr MapPart kLightPart = {0.0f, 0.76f};
constexpr double kShareSpan = 1e-5;  // shares below this part of the largest look alike

void set_theme(DrawList& list, Theme theme) {
    const bool is_dark = theme == Theme::Dark;
    list.background_top =
        linear_from_srgb(is_dark ? Vec3(0.175f, 0.195f, 0.225f) : Vec3(0.86f, 0.89f, 0.93f));
    list.background_bottom =
        linear_from_srgb(is_dark ? Vec3(0.085f, 0.09f, 0.10f) : Vec3(0.97f, 0.97f, 0.96f));
    list.wire_color = linear_from_srgb(is_dark ? Vec3(0.06f, 0.07f, 0.09f) : Vec3(0.15f, 0.17f, 0.20f));
    list.casing_color = linear_from_srgb(is_dark ? Vec3(0.02f, 0.03f, 0.05f) : Vec3(1.0f));
    list.red_color = linear_from_srgb(Vec3(0.93f, 0.16f, 0.12f));
    list.selection_color = linear_from_srgb(is_dark ? Vec3(1.0f, 0.55f, 0.95f) : Vec3(0.80f, 0.0f, 0.70f));
}

ColorScale make_colors(const ViewerState& state, int last_level, const BoxValues& values) {
    ColorScale colors;
    colors.meaning = state.box_color;
    const MapPart part = state.theme == Theme::Dark ? kDarkPart : kLightPart;
    for (size_t i = 0; i < kPaletteSize; ++i) {
        const float x = static_cast<float>(i) / static_cast<float>(kPaletteSize - 1);
        colors.palette[i] = map_linear(ColorMap::Viridis, part.from + x * (part.to - part.from));
    }
    const auto share_most = static_cast<double>(values.sah_share_range.upper);
    const auto share_least =
        std::max(static_cast<double>(values.sah_share_range.lower), kShareSpan * share_most);
    switch (state.box_color) {
        case BoxColor::Level:
            colors.scale = {0.0, std::max(1.0, static_cast<double>(last_level)), false};
            break;
        case BoxColor::Primitives:
            colors.scale = {static_cast<double>(values.references_range.lower),
                            static_cast<double>(values.references_range.upper), true};
            break;
        case BoxColor::SahShare:
            colors.scale = {share_least, share_most, true};
            break;
    }
    return colors;
}

/// Digits in groups of three.
std::string grouped(uint32_t count) {
    std::string digits = std::to_string(count);
    for (size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, ",");
    return digits;
}

}  // namespace

Vec3 ColorScale::color(double value) const {
    const float position = scale.position(value) * static_cast<float>(kPaletteSize - 1);
    const size_t first = std::min(static_cast<size_t>(position), kPaletteSize - 2);
    return glm::mix(palette[first], palette[first + 1], position - static_cast<float>(first));
}

BoxSelection select_boxes(const LevelTable& levels, const LevelRange& range, bool leaves_above) {
    BoxSelection selection;
    if (levels.level_count() == 0) return selection;
    const size_t deepest = levels.level_count() - 1;
    const size_t first = std::min(static_cast<size_t>(std::max(range.first, 0)), deepest);
    const size_t last = std::min(static_cast<size_t>(std::max(range.last, 0)), deepest);
    selection.first_level = static_cast<uint32_t>(first);
    selection.end = levels.level_begin[std::max(first, last) + 1];
    selection.leaves_above = leaves_above;
    selection.count = selection.end - levels.level_begin[first];
    if (!leaves_above) return selection;
    for (size_t level = 0; level < first; ++level) selection.count += levels.leaf_count[level];
    return selection;
}

DrawList make_draw_list(const ViewerState& state, const LevelTable& levels, const BoxValues& values,
                        const Selection& selection) {
    DrawList list;
    const bool is_traced = state.traced == TracedView::Over;
    list.mesh = !state.show_mesh ? MeshLook::Hidden : is_traced ? MeshLook::Depth : MeshLook::Shaded;
    list.wire = state.show_wire && list.mesh != MeshLook::Depth;
    list.red = state.show_red;
    list.reference_boxes = state.show_reference_boxes;
    list.see_through = state.see_through;
    list.interface_scale = state.interface_scale;
    list.line_width = kLineWidth * state.interface_scale;
    list.line_casing = kLineCasing * state.interface_scale;
    list.wire_width = kWireWidth * state.interface_scale;
    list.depth_fade = kDepthFade;
    list.size_fade = kSizeFade;
    set_theme(list, state.theme);
    const int deepest = std::max(static_cast<int>(levels.level_count()) - 1, 0);
    list.colors = make_colors(state, std::clamp(state.levels.last, 0, deepest), values);
    if (state.show_boxes && levels.level_count() > 0) {
        list.boxes = select_boxes(levels, state.levels, state.leaves_above);
    }
    if (selection.node < levels.list.nodes.size()) list.selected = levels.list.nodes[selection.node].bounds;
    list.selected_prim = selection.prim;
    return list;
}

std::string describe(const BoxCounts& counts) {
    if (counts.candidates == 0) return "no boxes";
    std::string text = grouped(counts.drawn);
    if (counts.drawn != counts.candidates) text += " of " + grouped(counts.candidates);
    text += counts.candidates == 1 ? " box" : " boxes";
    if (counts.over_budget > 0) text += ", the largest on screen";
    if (counts.outside > 0) text += "; " + grouped(counts.outside) + " outside the view";
    if (counts.under_pixel > 0) text += "; " + grouped(counts.under_pixel) + " under a pixel";
    return text;
}

}  // namespace boxwood
