#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/viewer/keys.h"
#include "app/viewer/panel_parts.h"

namespace boxwood::panel {
namespace {

enum Handle : int { kNone, kFirst, kLast, kBoth };

/// Nearest handle to a position; between two handles far apart: both, so that the range moves as one.
Handle handle_at(float x, float first_x, float last_x, float radius) {
    if (std::abs(x - first_x) <= radius || std::abs(x - last_x) <= radius) {
        if (first_x == last_x) return x < first_x ? kFirst : kLast;
        return std::abs(x - first_x) < std::abs(x - last_x) ? kFirst : kLast;
    }
    if (x > first_x && x < last_x) return kBoth;
    return x < first_x ? kFirst : kLast;
}

}  // namespace

bool level_slider(const Context& context, LevelRange& range, int deepest) {
    const float height = ImGui::GetFrameHeight(), width = ImGui::GetContentRegionAvail().x;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("##levels", {width, height});
    tooltip(context,
            "Levels whose boxes are drawn; level 0 is the root. Drag an end or the bar; [ and ] move the "
            "range, with Shift its last level alone.");

    const float radius = 0.36f * height;
    const float from = corner.x + radius, length = width - 2.0f * radius;
    const auto position = [&](int level) {
        return deepest > 0 ? from + length * static_cast<float>(level) / static_cast<float>(deepest) : from;
    };
    const LevelRange shown{std::min(range.first, deepest), std::min(range.last, deepest)};
    const float pointer = ImGui::GetIO().MousePos.x;
    int& handle = context.memory.dragged_handle;
    bool changed = false;
    if (ImGui::IsItemActivated()) {
        handle = handle_at(pointer, position(shown.first), position(shown.last), radius);
        context.memory.drag_offset = handle == kBoth ? pointer - position(shown.first) : 0.0f;
    }
    if (ImGui::IsItemActive() && deepest > 0) {
        const float share = (pointer - context.memory.drag_offset - from) / length;
        const int level =
            std::clamp(static_cast<int>(std::lround(share * static_cast<float>(deepest))), 0, deepest);
        LevelRange next = shown;
        if (handle == kFirst) next = {std::min(level, shown.last), shown.last};
        if (handle == kLast) next = {shown.first, std::max(level, shown.first)};
        if (handle == kBoth) next = moved(shown, level - shown.first, false, deepest);
        changed = !(next == shown);
        if (changed) range = next;
    }

    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const float middle = corner.y + 0.5f * height, half = 0.12f * height;
    const LevelRange now{std::min(range.first, deepest), std::min(range.last, deepest)};
    draw.AddRectFilled({corner.x, middle - half}, {corner.x + width, middle + half},
                       ImGui::GetColorU32(ImGuiCol_FrameBgActive), half);
    draw.AddRectFilled({position(now.first), middle - half}, {position(now.last), middle + half},
                       im_packed(context.colors.accent));
    for (int level = 0; level <= deepest && deepest <= 64; ++level) {
        draw.AddLine({position(level), middle + 1.6f * half}, {position(level), middle + 2.6f * half},
                     im_packed(context.colors.dim));
    }
    for (const int level : {now.first, now.last}) {
        draw.AddCircleFilled({position(level), middle}, radius, im_packed(context.colors.accent), 20);
        draw.AddCircle({position(level), middle}, radius, ImGui::GetColorU32(ImGuiCol_WindowBg), 20,
                       1.5f * context.scale);
    }
    return changed;
}

}  // namespace boxwood::panel
