#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>

#include "app/viewer/keys.h"
#include "app/viewer/number_text.h"
#include "app/viewer/panel_parts.h"

namespace boxwood::panel {
namespace {

constexpr ImGuiWindowFlags kBare = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoFocusOnAppearing |
                                   ImGuiWindowFlags_NoNav;

void begin_top(const char* name, const Context& context, float y) {
    const ViewRect& view = context.layout.view;
    ImGui::SetNextWindowPos({view.x + 0.5f * view.width, view.y + y}, ImGuiCond_Always, {0.5f, 0.0f});
    ImGui::SetNextWindowBgAlpha(0.92f);
    ImGui::Begin(name, nullptr, kBare | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::PushTextWrapPos(std::max(0.8f * view.width, 200.0f));
}

void end_top() {
    ImGui::PopTextWrapPos();
    ImGui::End();
}

void path_dialog(const Context& context, const char* title, const char* button, const char* hint, bool& ask,
                 const std::function<void(const std::string&)>& done) {
    if (ask) {
        ImGui::OpenPopup(title);
        context.memory.path.clear();
        ask = false;
    }
    const ViewRect& view = context.layout.view;
    ImGui::SetNextWindowPos({view.x + 0.5f * view.width, view.y + 0.35f * view.height}, ImGuiCond_Always,
                            {0.5f, 0.5f});
    if (!ImGui::BeginPopupModal(title, nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove))
        return;
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(420.0f * context.scale);
    bool accepted = ImGui::InputText("##path", &context.memory.path, ImGuiInputTextFlags_EnterReturnsTrue);
    note(context, hint);
    ImGui::Dummy({0.0f, 4.0f * context.scale});
    accepted |= ImGui::Button(button);
    ImGui::SameLine();
    if (ImGui::Button("Cancel") || ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)))
        ImGui::CloseCurrentPopup();
    if (accepted && !context.memory.path.empty()) {
        done(context.memory.path);
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndPopup();
}

/// What became of a side's boxes; empty where none are to be drawn.
std::string boxes_text(const ViewerState& state, const SideInput& side) {
    std::string text;
    if (state.show_boxes && side.built != nullptr) text = describe(side.boxes);
    if (state.show_reference_boxes)
        text += (text.empty() ? "pieces: " : "; pieces: ") + describe(side.reference_boxes);
    return text;
}

}  // namespace

void status_line(const Context& context) {
    const ViewRect& rect = context.layout.status;
    ImGui::SetNextWindowPos({rect.x, rect.y});
    ImGui::SetNextWindowSize({rect.width, rect.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8.0f * context.scale, 4.0f * context.scale});
    ImGui::Begin("status", nullptr, kBare);
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    std::string text;
    for (const Side side : kSides) {
        if (!context.state.has(side)) continue;
        const std::string of = boxes_text(context.state, context.input.side(side));
        if (!context.state.compares()) {
            text = of;
        } else if (!of.empty()) {
            text += std::string(text.empty() ? "" : "   ") + side_name(side) + ": " + of;
        }
    }
    if (text.empty()) text = "no boxes are drawn";
    const std::string keys = "? keys";
    const float keys_at = rect.width - ImGui::CalcTextSize(keys.c_str()).x - 10.0f * context.scale;
    colored(context.colors.dim, beginning_of(text, keys_at - ImGui::GetCursorPosX() - 10.0f * context.scale));
    tooltip(context, text);
    ImGui::SameLine(keys_at);
    colored(context.colors.dim, keys);
    ImGui::PopFont();
    ImGui::End();
    ImGui::PopStyleVar();
}

void message_line(const Context& context) {
    if (context.input.message.empty()) return;
    begin_top("message", context, 8.0f * context.scale);
    if (ImGui::SmallButton("x")) context.actions.push_back(DismissMessage{});
    ImGui::SameLine();
    colored(context.input.message_is_error ? context.colors.error : context.colors.text,
            context.input.message);
    end_top();
}

void work_line(const Context& context) {
    const BuildProgress& progress = context.input.progress;
    constexpr double kPatience = 150.0;  // ms until work is worth a line
    if (!progress.running || progress.ms < kPatience) return;
    begin_top("work", context, context.input.message.empty() ? 8.0f * context.scale : 56.0f * context.scale);
    ImGui::TextUnformatted((progress.sentence + ", " + time_text(progress.ms)).c_str());
    constexpr double kRound = 2000.0;  // ms that a bar of unknown end takes to fill again and again
    const double filled = progress.share >= 0.0 ? progress.share : std::fmod(progress.ms, kRound) / kRound;
    const float share = static_cast<float>(filled);
    ImGui::ProgressBar(share, {260.0f * context.scale, 0.0f}, progress.share >= 0.0 ? nullptr : "");
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) context.actions.push_back(CancelWork{});
    tooltip(context, "Esc: what is on screen stays.");
    end_top();
}

void key_list(const Context& context) {
    const ViewRect& view = context.layout.view;
    ImGui::SetNextWindowPos({view.x + 0.5f * view.width, view.y + 0.5f * view.height}, ImGuiCond_Always,
                            {0.5f, 0.5f});
    ImGui::SetNextWindowBgAlpha(0.94f);
    ImGui::Begin("keys", nullptr, kBare | ImGuiWindowFlags_AlwaysAutoResize);
    std::string_view group;
    const float column = 102.0f * context.scale;
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    const auto list = [&](size_t begin, size_t end) {
        ImGui::BeginGroup();
        group = {};  // a column begins with its heading
        const float left = ImGui::GetCursorPosX();
        for (const KeyHelp& row : key_help().subspan(begin, end - begin)) {
            if (group != row.group) {
                group = row.group;
                colored(context.colors.accent, row.group);
            }
            ImGui::TextUnformatted(row.keys);
            ImGui::SameLine();
            ImGui::SetCursorPosX(left + column);
            colored(context.colors.dim, row.what);
        }
        ImGui::EndGroup();
    };
    const size_t count = key_help().size(), half = (count + 1) / 2;
    list(0, half);
    ImGui::SameLine(0.0f, 14.0f * context.scale);
    list(half, count);
    ImGui::PopFont();
    ImGui::End();
}

void dialogs(const Context& context) {
    path_dialog(
        context, "Open", "Open",
        "A scene file or built-in name with suffixes such as terrain@tris=100k, a session, or a picture "
        "that carries one. Files can also be dropped on the window.",
        context.memory.ask_open, [&](const std::string& path) { context.actions.push_back(OpenPath{path}); });
    path_dialog(context, "Save session", "Save", "A file name that ends in .json.", context.memory.ask_save,
                [&](const std::string& path) { context.actions.push_back(SaveSession{path}); });
}

}  // namespace boxwood::panel
