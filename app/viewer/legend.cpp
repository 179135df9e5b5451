#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/viewer/number_text.h"
#include "app/viewer/panel_parts.h"

namespace boxwood::panel {
namespace {

constexpr ImGuiWindowFlags kFloating = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                       ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                       ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav |
                                       ImGuiWindowFlags_NoInputs;

constexpr float kLegendWidth = 200.0f;     // of the strip, in pixels at scale 1
constexpr float kNarrowestLegend = 70.0f;  // a narrower view has none

/// One legend: a strip of colours with the values at its ends and a mark.
struct Legend {
    std::string title, lower, middle, upper;
    bool discrete = false;
    int steps = 64;
    std::optional<float> mark;                           ///< position in [0, 1]
    std::string pointed;                                 ///< what lies under the pointer, in words
    std::vector<std::pair<Vec3, std::string>> swatches;  ///< colours beside the strip, sRGB
};

template <class Color>
void strip(const Context& context, const Legend& legend, float width, const Color& color) {
    const float height = 12.0f * context.scale;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const int count = legend.steps;
    for (int i = 0; i < count; ++i) {
        const float x0 = corner.x + width * static_cast<float>(i) / static_cast<float>(count);
        const float x1 = corner.x + width * static_cast<float>(i + 1) / static_cast<float>(count);
        const float at = legend.discrete ? static_cast<float>(i) / static_cast<float>(std::max(count - 1, 1))
                                         : (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
        draw.AddRectFilled({x0, corner.y}, {x1, corner.y + height}, im_packed(color(at)));
    }
    if (legend.mark) {
        const float inset = legend.discrete ? 0.5f * width / static_cast<float>(count) : 0.0f;
        const float x = corner.x + inset + (width - 2.0f * inset) * *legend.mark;
        const float size = 4.0f * context.scale;
        draw.AddTriangleFilled({x - size, corner.y - size}, {x + size, corner.y - size}, {x, corner.y + size},
                               im_packed(context.colors.text));
    }
    ImGui::Dummy({width, height});
    const float left = ImGui::GetCursorPosX();
    colored(context.colors.dim, legend.lower);
    const auto place = [&](const std::string& text, float share) {
        if (text.empty()) return;
        ImGui::SameLine(left + share * (width - ImGui::CalcTextSize(text.c_str()).x));
        colored(context.colors.dim, text);
    };
    if (width >= kLegendWidth * context.scale) place(legend.middle, 0.5f);
    place(legend.upper, 1.0f);
}

/// Returns the height of the window.
template <class Color>
float legend_window(const Context& context, const char* name, const ViewRect& view, const Legend& legend,
                    const Color& color) {
    const float margin = 8.0f * context.scale;
    const float room = view.width - 2.0f * (margin + ImGui::GetStyle().WindowPadding.x);
    const float width = std::min(kLegendWidth * context.scale, room);
    if (width < kNarrowestLegend * context.scale) return 0.0f;
    ImGui::SetNextWindowPos({view.x + view.width - margin, view.y + view.height - margin}, ImGuiCond_Always,
                            {1.0f, 1.0f});
    ImGui::SetNextWindowBgAlpha(0.92f);
    ImGui::Begin(name, nullptr, kFloating);
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + room);
    ImGui::TextUnformatted(legend.title.c_str());
    strip(context, legend, width, color);
    for (const auto& [color_of, text] : legend.swatches) swatch(context, color_of, text);
    if (!legend.pointed.empty()) ImGui::TextUnformatted(legend.pointed.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
    const float height = ImGui::GetWindowHeight();
    ImGui::End();
    return height;
}

/// In percent, small ones as powers of ten.
std::string share_text(double share) { return number_text(100.0 * share, 2) + " %"; }

/// "A: 12, B: 9" or, of one recipe, "12".
template <class Text>
std::string of_sides(const Context& context, const Text& text_of) {
    std::string text;
    for (const Side side : kSides) {
        if (!context.state.has(side)) continue;
        if (context.state.compares()) text += std::string(text.empty() ? "" : "\n") + side_name(side) + ": ";
        text += text_of(context.input.side(side));
    }
    return text;
}

void visits_legend(const Context& context, Legend& legend) {
    const Visits* visits = context.side.visits;
    const bool of_ray = context.state.visit_rays == VisitRays::Picked;
    const double most = context.input.scale.scale.upper;
    if (visits == nullptr) {
        legend.title = of_ray ? "visits of a ray: click a pixel" : "visits: casting all rays of the view";
    } else {
        legend.title = of_ray ? "visits by the picked ray"
                              : "visits by " + grouped(visits->ray_count) + " rays, logarithmic";
        legend.pointed = of_sides(context, [](const SideInput& side) {
            if (side.visits == nullptr) return std::string("\u2013");
            return grouped(side.visits->visited_nodes) + " of " + grouped(side.visits->by_node.size()) +
                   " nodes visited";
        });
    }
    legend.lower = "1";
    if (most > 1.0) legend.upper = grouped(static_cast<uint64_t>(most));
    legend.steps = most > 1.0 ? 64 : 1;
    if (most <= 1.0) legend.lower = "1 visit";
    if (context.state.show_unvisited)
        legend.swatches.push_back({context.input.unvisited_color, "not visited"});
}

void swatches(const Context& context, Legend& legend) {
    const auto any = [&](const auto& holds) { return std::ranges::any_of(context.input.sides, holds); };
    const bool has_empty =
        any([](const SideInput& side) { return side.tree != nullptr && side.tree->empty_leaves > 0; });
    if (context.state.show_empty && has_empty && context.state.box_color != BoxColor::Visits) {
        legend.swatches.push_back({context.input.empty_color, "empty cell"});
    }
    const bool has_shared = any([](const SideInput& side) { return side.shared_count > 0; });
    if (context.state.show_shared && context.state.show_mesh && has_shared)
        legend.swatches.push_back({context.input.shared_color, "triangle in several leaves"});
}

Legend box_legend(const Context& context) {
    const ColorScale& colors = context.input.scale;
    const ValueScale& scale = colors.scale;
    Legend legend;
    const double lower = scale.lower, upper = scale.upper;
    const std::optional<Pointed>& pointed = context.input.pointed;
    const SideInput& side = context.input.side(context.input.pointed_side);
    const std::string here =
        context.state.compares() ? std::string(side_name(context.input.pointed_side)) + ": " : std::string();
    const bool has_node = pointed && pointed->node != kNoIndex;
    double value = 0.0;
    if (colors.meaning == BoxColor::Level) {
        legend.title = "level of a box";
        legend.lower = number_text(lower), legend.upper = number_text(upper);
        legend.steps = std::clamp(static_cast<int>(upper - lower) + 1, 1, 64);
        legend.discrete = upper - lower < 64.0;
        if (has_node) value = static_cast<double>(pointed->level);
    } else if (colors.meaning == BoxColor::Primitives) {
        legend.title = "references below a box, logarithmic";
        legend.lower = grouped(static_cast<uint64_t>(lower)),
        legend.upper = grouped(static_cast<uint64_t>(upper));
        legend.middle = number_text(scale.value(0.5), 3);
        if (has_node) value = pointed->references;
    } else if (colors.meaning == BoxColor::Visits) {
        visits_legend(context, legend);
    } else {
        legend.title = "a box's own share of the SAH cost, logarithmic";
        legend.lower = share_text(lower), legend.upper = share_text(upper);
        legend.middle = share_text(scale.value(0.5));
        if (has_node) value = pointed->sah_share;
    }
    swatches(context, legend);
    if (has_node && colors.meaning == BoxColor::Visits) {
        const Visits* visits = side.visits;
        if (visits == nullptr) return legend;
        const uint32_t count = visits->by_node[pointed->node];
        if (count > 0) legend.mark = scale.position(count);
        legend.pointed += "\n" + (here.empty() ? "here: " : here) + "level " +
                          std::to_string(pointed->level) + ", " + grouped(count) +
                          (count == 1 ? " visit" : " visits");
    } else if (has_node) {
        legend.mark = scale.position(value);
        legend.pointed = here + (pointed->leaf ? "leaf" : "node") + " at level " +
                         std::to_string(pointed->level) + ": " +
                         grouped(static_cast<uint64_t>(pointed->references)) + " references, " +
                         share_text(pointed->sah_share) + " of cost";
        if (pointed->hit_references > 1) {
            legend.pointed += "\ntriangle in " + grouped(pointed->hit_references) + " references";
        } else if (side.values != nullptr && pointed->hit.prim < side.values->prim_leaves.size() &&
                   side.values->prim_leaves[pointed->hit.prim] > 1) {
            legend.pointed +=
                "\ntriangle in " + grouped(side.values->prim_leaves[pointed->hit.prim]) + " leaves";
        }
    }
    return legend;
}

const char* heat_words(Shading shading) {
    return shading == Shading::Heat        ? "nodes visited"
           : shading == Shading::HeatTests ? "triangles tested"
                                           : "exact decisions";
}

std::string count_text(const Count& count) {
    return grouped(count.nodes) + " nodes, " + grouped(count.tests) + " tests, " + grouped(count.exact) +
           " exact";
}

/// The pixel under the pointer in both pictures; empty where it is not known.
std::string pixel_text(const Context& context) {
    if (!context.side.pixel) return {};
    return of_sides(context, [](const SideInput& side) {
        return side.pixel ? count_text(side.pixel->count) : std::string("\u2013");
    });
}

Legend heat_legend(const Context& context) {
    const HeatComparison* both = context.input.heat;
    const HeatScale& heat = both != nullptr ? both->scale : context.side.trace.heat;
    const Shading shading = both != nullptr ? both->settings.shading : context.state.shading;
    Legend legend;
    legend.title = std::string(heat_words(shading)) + " by a primary ray" +
                   (heat.scale.logarithmic ? ", logarithmic" : "");
    legend.lower = number_text(heat.scale.lower, 3);
    legend.middle = number_text(heat.scale.value(0.5), 3);
    const bool beyond = heat.largest > heat.scale.upper;
    legend.upper =
        number_text(heat.scale.upper, 4) + (beyond ? " (most " + number_text(heat.largest, 4) + ")" : "");
    const std::optional<PixelValue>& pixel = context.input.side(context.input.pointed_side).pixel;
    if (pixel) {
        const uint64_t value = heat_count(pixel->count, shading);
        legend.mark = heat.scale.position(static_cast<double>(value));
        legend.pointed = (both != nullptr ? "" : "this pixel: ") + pixel_text(context);
    }
    return legend;
}

std::string signed_text(double value, int digits) {
    return (value > 0.0 ? "+" : value < 0.0 ? "\u2212" : "") + number_text(std::abs(value), digits);
}

/// Symmetric: zero is in its middle.
Legend difference_legend(const Context& context, const HeatComparison& heat) {
    const SignedScale& scale = heat.difference_scale;
    const Shading shading = heat.settings.shading;
    Legend legend;
    legend.title = std::string("A \u2212 B: ") + heat_words(shading) + " by a primary ray" +
                   (scale.logarithmic ? ", logarithmic" : "");
    legend.lower = signed_text(-scale.most, 3);
    legend.middle = "0";
    legend.upper = signed_text(scale.most, 3);
    const double known = std::max(static_cast<double>(heat.known), 1.0);
    const auto part = [&](uint64_t count) {
        return " does more: " + percent_text(static_cast<double>(count), known) + " of pixels";
    };
    legend.swatches = {{side_color(context.state.theme, Side::A), "A" + part(heat.more_in_a)},
                       {side_color(context.state.theme, Side::B), "B" + part(heat.more_in_b)}};
    if (scale.largest > scale.most) legend.pointed = "most: " + number_text(scale.largest, 4);
    const std::optional<PixelValue>&a = context.input.side(Side::A).pixel,
          &b = context.input.side(Side::B).pixel;
    if (a && b) {
        const auto difference = static_cast<double>(heat_difference(a->count, b->count, shading));
        legend.mark = 0.5f + 0.5f * scale.position(difference);
        legend.pointed =
            pixel_text(context) + "\nA \u2212 B: " + signed_text(difference, 6) + " " + heat_words(shading);
    }
    return legend;
}

/// How many pixels are marked as wrong, in the upper left corner of the traced view.
void wrong_legend(const Context& context) {
    if (context.side.check == nullptr || context.state.traced == TracedView::Off) return;
    const auto text_of = [&](const SideInput& side) {
        if (side.check == nullptr) return std::string("\u2013");
        return grouped(side.check->modes[static_cast<size_t>(context.state.mode)].wrong()) + " wrong of " +
               grouped(side.check->checked) + (context.state.compares() ? "" : "\nrays checked, ") +
               (context.state.compares()            ? ""
                : context.state.mode == Mode::Exact ? "exact mode"
                                                    : "fast mode");
    };
    const float margin = 8.0f * context.scale;
    const ViewRect& traced = context.layout.side(Side::A).traced.rect;
    ImGui::SetNextWindowPos({traced.x + margin, traced.y + margin + label_height(context)});
    ImGui::SetNextWindowBgAlpha(0.92f);
    ImGui::Begin("wrong legend", nullptr, kFloating);
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    swatch(context, kWrongColor, of_sides(context, text_of));
    ImGui::PopFont();
    ImGui::End();
}

}  // namespace

void legends(const Context& context) {
    const ViewerState& state = context.state;
    // Of both sides, in the corner of the last picture.
    const SideLayout& places = context.layout.side(state.compares() ? Side::B : Side::A);
    float box_height = 0.0f;
    const bool has_nodes = std::ranges::any_of(context.input.sides, [](const SideInput& side) {
        return side.built != nullptr && side.built->levels->level_count() > 0;
    });
    if (state.show_boxes && has_nodes) {
        const ColorScale& scale = context.input.scale;
        const auto color = [&](float x) {
            if (scale.scale.upper <= 1.0 && scale.meaning == BoxColor::Visits) x = 1.0f;
            const float last = static_cast<float>(scale.palette.size() - 1);
            const float at = std::clamp(x, 0.0f, 1.0f) * last;
            const size_t i = std::min(static_cast<size_t>(at), scale.palette.size() - 2);
            return srgb_from_linear(
                glm::mix(scale.palette[i], scale.palette[i + 1], at - static_cast<float>(i)));
        };
        box_height = legend_window(context, "box legend", places.scene.rect, box_legend(context), color);
    }
    const bool has_heat = context.input.heat != nullptr || context.side.trace.step > 0;
    if (state.traced != TracedView::Off && is_heat(state.shading) && has_heat) {
        ViewRect place = places.traced.rect;
        if (state.traced == TracedView::Over && state.show_boxes)
            place.height -= std::max(72.0f * context.scale, box_height + 8.0f * context.scale);
        if (state.shows_difference() && context.input.heat != nullptr) {
            const bool is_dark = state.theme == Theme::Dark;
            legend_window(context, "heat legend", place, difference_legend(context, *context.input.heat),
                          [&](float x) { return diverging_srgb(2.0f * x - 1.0f, is_dark); });
        } else {
            legend_window(context, "heat legend", place, heat_legend(context),
                          [&](float x) { return map_srgb(state.color_map, x); });
        }
    }
    wrong_legend(context);
}

}  // namespace boxwood::panel
