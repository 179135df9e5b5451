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

void visits_legend(const Context& context, Legend& legend) {
    const Visits* visits = context.input.visits;
    const bool of_ray = context.state.visit_rays == VisitRays::Picked;
    const double most = context.input.scale.scale.upper;
    if (visits == nullptr) {
        legend.title = of_ray ? "visits of a ray: click a pixel" : "visits: casting all rays of the view";
    } else {
        legend.title = of_ray ? "visits by the picked ray"
                              : "visits by " + grouped(visits->ray_count) + " rays, logarithmic";
        legend.pointed =
            grouped(visits->visited_nodes) + " of " + grouped(visits->by_node.size()) + " nodes visited";
    }
    legend.lower = "1";
    if (most > 1.0) legend.upper = grouped(static_cast<uint64_t>(most));
    legend.steps = most > 1.0 ? 64 : 1;
    if (most <= 1.0) legend.lower = "1 visit";
    if (context.state.show_unvisited)
        legend.swatches.push_back({context.input.unvisited_color, "not visited"});
}

void swatches(const Context& context, Legend& legend) {
    if (context.state.show_empty && context.input.tree != nullptr && context.input.tree->empty_leaves > 0 &&
        context.state.box_color != BoxColor::Visits) {
        legend.swatches.push_back({context.input.empty_color, "empty cell"});
    }
    if (context.state.show_shared && context.state.show_mesh && context.input.shared_count > 0)
        legend.swatches.push_back({context.input.shared_color, "triangle in several leaves"});
}

Legend box_legend(const Context& context) {
    const ColorScale& colors = context.input.scale;
    const ValueScale& scale = colors.scale;
    Legend legend;
    const double lower = scale.lower, upper = scale.upper;
    const std::optional<Pointed>& pointed = context.input.pointed;
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
        const Visits* visits = context.input.visits;
        if (visits == nullptr) return legend;
        const uint32_t count = visits->by_node[pointed->node];
        if (count > 0) legend.mark = scale.position(count);
        legend.pointed += "\nhere: level " + std::to_string(pointed->level) + ", " + grouped(count) +
                          (count == 1 ? " visit" : " visits");
    } else if (has_node) {
        legend.mark = scale.position(value);
        legend.pointed = std::string(pointed->leaf ? "leaf" : "node") + " at level " +
                         std::to_string(pointed->level) + ": " +
                         grouped(static_cast<uint64_t>(pointed->references)) + " references, " +
                         share_text(pointed->sah_share) + " of cost";
        if (pointed->hit_references > 1) {
            legend.pointed += "\ntriangle in " + grouped(pointed->hit_references) + " references";
        } else if (context.input.values != nullptr &&
                   pointed->hit.prim < context.input.values->prim_leaves.size() &&
                   context.input.values->prim_leaves[pointed->hit.prim] > 1) {
            legend.pointed +=
                "\ntriangle in " + grouped(context.input.values->prim_leaves[pointed->hit.prim]) + " leaves";
        }
    }
    return legend;
}

Legend heat_legend(const Context& context) {
    const HeatScale& heat = context.input.trace.heat;
    const bool nodes = context.state.shading == Shading::Heat;
    Legend legend;
    legend.title = std::string(nodes ? "nodes visited" : "triangles tested") + " by a primary ray" +
                   (heat.scale.logarithmic ? ", logarithmic" : "");
    legend.lower = number_text(heat.scale.lower, 3);
    legend.middle = number_text(heat.scale.value(0.5), 3);
    const bool beyond = heat.largest > heat.scale.upper;
    legend.upper =
        number_text(heat.scale.upper, 4) + (beyond ? " (most " + number_text(heat.largest, 4) + ")" : "");
    if (const std::optional<PixelValue>& pixel = context.input.pixel) {
        const uint64_t value = nodes ? pixel->count.nodes : pixel->count.tests;
        legend.mark = heat.scale.position(static_cast<double>(value));
        legend.pointed = "this pixel: " + grouped(pixel->count.nodes) + " nodes, " +
                         grouped(pixel->count.tests) + " tests";
    }
    return legend;
}

/// How many pixels are marked as wrong, in the upper left corner of the traced view.
void wrong_legend(const Context& context) {
    const bench::PictureCheck* check = context.input.check;
    if (check == nullptr || context.state.traced == TracedView::Off) return;
    const bench::ModeCheck& mode = check->modes[static_cast<size_t>(context.state.mode)];
    const float margin = 8.0f * context.scale;
    ImGui::SetNextWindowPos({context.layout.traced.x + margin, context.layout.traced.y + margin});
    ImGui::SetNextWindowBgAlpha(0.92f);
    ImGui::Begin("wrong legend", nullptr, kFloating);
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    swatch(context, kWrongColor,
           grouped(mode.wrong()) + " wrong of " + grouped(check->checked) + "\nrays checked, " +
               (context.state.mode == Mode::Exact ? "exact" : "fast") + " mode");
    ImGui::PopFont();
    ImGui::End();
}

}  // namespace

void legends(const Context& context) {
    const ViewerState& state = context.state;
    const Built* built = context.input.built;
    float box_height = 0.0f;
    if (state.show_boxes && built != nullptr && built->levels->level_count() > 0) {
        const ColorScale& scale = context.input.scale;
        const auto color = [&](float x) {
            if (scale.scale.upper <= 1.0 && scale.meaning == BoxColor::Visits) x = 1.0f;
            const float last = static_cast<float>(scale.palette.size() - 1);
            const float at = std::clamp(x, 0.0f, 1.0f) * last;
            const size_t i = std::min(static_cast<size_t>(at), scale.palette.size() - 2);
            return srgb_from_linear(
                glm::mix(scale.palette[i], scale.palette[i + 1], at - static_cast<float>(i)));
        };
        box_height = legend_window(context, "box legend", context.layout.scene, box_legend(context), color);
    }
    if (state.traced != TracedView::Off && is_heat(state.shading) && context.input.trace.step > 0) {
        ViewRect place = context.layout.traced;
        if (state.traced == TracedView::Over && state.show_boxes)
            place.height -= std::max(72.0f * context.scale, box_height + 8.0f * context.scale);
        legend_window(context, "heat legend", place, heat_legend(context),
                      [&](float x) { return map_srgb(state.color_map, x); });
    }
    wrong_legend(context);
}

}  // namespace boxwood::panel
