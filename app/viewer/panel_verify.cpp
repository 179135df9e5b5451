#include <imgui.h>

#include <array>

#include "app/viewer/number_text.h"
#include "app/viewer/panel_parts.h"
#include "app/viewer/session_fields.h"

namespace boxwood::panel {
namespace {

constexpr std::array<const char*, 4> kCountNames{"1,000 rays", "10,000 rays", "100,000 rays", "all rays"};
constexpr std::array<int, 4> kCounts{1000, 10000, 100000, kMostVerifyRays};
constexpr size_t kMostMarks = 20000;

std::string per_million(uint64_t wrong, uint64_t checked) {
    if (checked == 0) return "\u2013";
    return number_text(1e6 * static_cast<double>(wrong) / static_cast<double>(checked), 3);
}

void row(const Context& context, const char* name, const std::array<std::string, 2>& values,
         const std::string& tip) {
    ImGui::TableNextRow();
    ImGui::TableSetColumnIndex(0);
    colored(context.colors.dim, name);
    tooltip(context, tip);
    for (size_t i = 0; i < values.size(); ++i) {
        ImGui::TableSetColumnIndex(static_cast<int>(i) + 1);
        const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(values[i].c_str()).x;
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(free, 0.0f));
        ImGui::TextUnformatted(values[i].c_str());
        tooltip(context, tip);
    }
}

void result_table(const Context& context, const bench::PictureCheck& check) {
    const auto both = [&](const auto& text) {
        return std::array<std::string, 2>{text(check.modes[0]), text(check.modes[1])};
    };
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    if (ImGui::BeginTable("verify", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_SizingStretchProp)) {
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 2.2f);
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.0f);
        ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, 1.0f);
        row(context, "intersection", {"exact", "fast"}, "How rays decide what they hit.");
        using Mode = bench::ModeCheck;
        if (context.state.show_times) {
            row(context, "rays per second", both([](const Mode& mode) {
                    return mode.rays_per_second > 0.0 ? rate_text(mode.rays_per_second)
                                                      : std::string("\u2013");
                }),
                "The picture's primary rays, in turns in both modes, on all cores: " +
                    grouped(check.modes[0].timed_rays) + " and " + grouped(check.modes[1].timed_rays) +
                    " rays timed. Higher is better.");
        }
        row(context, "wrong rays per million",
            both([&](const Mode& mode) { return per_million(mode.wrong(), check.checked); }),
            "Answers that differ from rational arithmetic, over the rays that were checked. Lower is "
            "better.");
        row(context, "wrong rays", both([](const Mode& mode) { return grouped(mode.wrong()); }),
            "Of " + grouped(check.checked) + " rays checked.");
        row(context, "hit or miss", both([](const Mode& mode) { return grouped(mode.wrong_hits); }),
            "A hit where there is none, or none where there is one.");
        row(context, "triangle", both([](const Mode& mode) { return grouped(mode.wrong_prims); }),
            "Another triangle than the nearest; of equally near ones the lowest number is right.");
        row(context, "distance", {grouped(check.modes[0].wrong_t), "\u2013"},
            "Exact mode: another distance than the exact one rounded once to float. Fast mode promises a "
            "bound "
            "only, see `boxwood bench error`.");
        ImGui::EndTable();
    }
    ImGui::PopFont();
}

void result(const Context& context, const bench::PictureCheck& check) {
    result_table(context, check);
    const std::string of = check.checked == check.rays ? "All " + grouped(check.rays) + " rays"
                                                       : grouped(check.checked) + " of " +
                                                             grouped(check.rays) + " rays, evenly spread,";
    std::string text = of + " through the pixel centres of this " +
                       (context.state.traced == TracedView::Off ? "view" : "ray-traced view") +
                       " were compared with rational arithmetic";
    text += context.state.show_times ? ", in " + time_text(check.ms) + "." : ".";
    if (check.modes[0].wrong() + check.modes[1].wrong() > 0) {
        text += context.state.traced == TracedView::Off
                    ? " With the ray-traced view (T) the wrong pixels are marked."
                    : " The wrong pixels of the mode that is shown are marked in the ray-traced view.";
    }
    note(context, text);
}

void marks_of(const Context& context, const bench::PictureCheck& check, const PicturePlace& place) {
    const ViewRect &view = place.rect, &part = place.part;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    draw.PushClipRect({part.x, part.y}, {part.x + part.width, part.y + part.height}, true);
    const uint32_t dark = im_packed(Vec3(0.0f)), bright = im_packed(kWrongColor);
    const float radius = 4.0f * context.scale;
    const auto width = static_cast<uint32_t>(check.width);
    size_t left = kMostMarks;
    for (const uint32_t pixel : check.modes[static_cast<size_t>(context.state.mode)].wrong_pixels) {
        if (left-- == 0) break;
        const float x = view.x + static_cast<float>(pixel % width) + 0.5f;
        const float y = view.y + static_cast<float>(pixel / width) + 0.5f;
        draw.AddCircle({x, y}, radius, dark, 16, 3.2f * context.scale);
        draw.AddCircle({x, y}, radius, bright, 16, 1.8f * context.scale);
        draw.AddRectFilled({x - 0.5f, y - 0.5f}, {x + 0.5f, y + 0.5f}, bright);
    }
    draw.PopClipRect();
}

}  // namespace

void verify_part(const Context& context) {
    ViewerState& s = context.state;
    if (context.side.built == nullptr) {
        note(context, "No structure yet.");
        return;
    }
    int& choice = context.memory.verify_count;
    const float button = 64.0f * context.scale;
    ImGui::SetNextItemWidth(-button - ImGui::GetStyle().ItemSpacing.x);
    ImGui::Combo("##count", &choice, kCountNames.data(), static_cast<int>(kCountNames.size()));
    tooltip(context,
            "How many of the picture's rays are compared, evenly spread. In a large scene a ray takes "
            "milliseconds: each is judged by all triangles, without any tree.");
    ImGui::SameLine();
    const bool runs = s.verify_rays > 0 && context.side.check == nullptr;
    if (runs) {
        if (ImGui::Button("Cancel", {button, 0.0f})) context.actions.push_back(CancelCheck{});
        tooltip(context, "Stops the check.");
    } else {
        if (ImGui::Button("Verify", {button, 0.0f})) s.verify_rays = kCounts[static_cast<size_t>(choice)];
        tooltip(context,
                "Casts the picture's rays in both modes and compares every answer with rational arithmetic, "
                "which makes no error.");
    }
    if (runs) {
        const WorkProgress& progress = context.side.check_progress;
        ImGui::ProgressBar(static_cast<float>(std::max(progress.share, 0.0)), {-1.0f, 0.0f});
        tooltip(context, "Rays cast in both modes and judged, " + time_text(progress.ms) + ".");
    } else if (context.side.check != nullptr) {
        result(context, *context.side.check);
    } else {
        note(context,
             "Compares what the structure answers with rational arithmetic, for the rays of this view. "
             "Another "
             "view, recipe or size takes the result back.");
    }
}

void wrong_marks(const Context& context) {
    if (context.state.traced == TracedView::Off) return;
    for (const Side side : kSides) {
        const bench::PictureCheck* check = context.input.side(side).check;
        const PicturePlace& place = context.layout.side(side).traced;
        if (check != nullptr && place.is_seen()) marks_of(context, *check, place);
    }
}

}  // namespace boxwood::panel
