#include "app/viewer/panel_parts.h"

#include <imgui.h>

#include <algorithm>
#include <array>

namespace boxwood::panel {

std::string beginning_of(const std::string& text, float width) {
    const auto is_inside_character = [&](size_t i) {
        return (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80;
    };
    std::string shown = text;
    for (size_t kept = text.size(); kept > 0 && ImGui::CalcTextSize(shown.c_str()).x > width;) {
        --kept;
        if (!is_inside_character(kept)) shown = text.substr(0, kept) + "...";
    }
    return shown;
}

void tooltip(const Context& context, const std::string& text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(320.0f * context.scale);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

void heading(const Context& context, const char* title, const std::string& right_note) {
    ImGui::Dummy({0.0f, 2.0f * context.scale});
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[2]);
    ImGui::TextUnformatted(title);
    ImGui::PopFont();
    if (!right_note.empty()) {
        const float width = ImGui::CalcTextSize(right_note.c_str()).x;
        ImGui::SameLine(ImGui::GetContentRegionMax().x - width);
        colored(context.colors.dim, right_note);
    }
    ImGui::Separator();
}

void note(const Context& context, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, im_color(context.colors.dim));
    ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopFont();
    ImGui::PopStyleColor();
}

void colored(const Vec4& color, const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, im_color(color));
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

void value_row(const Context& context, const char* name, const std::string& value, const std::string& tip) {
    ImGui::BeginGroup();
    const float value_x = ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(value.c_str()).x;
    const float room = value_x - ImGui::GetStyle().ItemSpacing.x - ImGui::GetCursorPosX();
    colored(context.colors.dim, beginning_of(name, room));
    ImGui::SameLine();
    ImGui::SetCursorPosX(value_x);
    ImGui::TextUnformatted(value.c_str());
    ImGui::EndGroup();
    tooltip(context, tip);
}

void swatch(const Context& context, const Vec3& srgb, const std::string& text) {
    const float size = 0.7f * ImGui::GetTextLineHeight();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float top = at.y + 0.5f * (ImGui::GetTextLineHeight() - size);
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, top}, {at.x + size, top + size}, im_packed(srgb),
                                              1.5f * context.scale);
    ImGui::Dummy({size, ImGui::GetTextLineHeight()});
    ImGui::SameLine();
    ImGui::TextUnformatted(text.c_str());
}

void right_text(const std::string& text) {
    const float free = ImGui::GetContentRegionAvail().x - ImGui::CalcTextSize(text.c_str()).x;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(free, 0.0f));
    ImGui::TextUnformatted(text.c_str());
}

void copy_buttons(const Context& context, const char* id, const std::function<std::string()>& tsv,
                  const std::function<std::string()>& markdown, const std::function<std::string()>& json) {
    const std::array<std::pair<const char*, const std::function<std::string()>*>, 3> kinds{
        {{"TSV", &tsv}, {"Markdown", &markdown}, {"JSON", &json}}};
    colored(context.colors.dim, "copy as");
    ImGui::PushID(id);
    for (const auto& [name, text] : kinds) {
        ImGui::SameLine();
        if (ImGui::SmallButton(name)) context.actions.push_back(CopyText{(*text)()});
        tooltip(context, std::string("Copies this table as ") + name + ".");
    }
    ImGui::PopID();
}

std::optional<size_t> tabs(const Context& context, std::span<const Tab> all, size_t shown) {
    std::optional<size_t> chosen;
    for (size_t i = 0; i < all.size(); ++i) {
        const bool is_shown = shown == i;
        if (i > 0) ImGui::SameLine(0.0f, 18.0f * context.scale);
        ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[2]);
        colored(is_shown ? context.colors.text : context.colors.dim, all[i].name);
        ImGui::PopFont();
        if (ImGui::IsItemClicked()) chosen = i;
        const ImVec2 lower = ImGui::GetItemRectMin(), upper = ImGui::GetItemRectMax();
        if (is_shown || ImGui::IsItemHovered()) {
            ImGui::GetWindowDrawList()->AddRectFilled(
                {lower.x, upper.y + 1.0f * context.scale}, {upper.x, upper.y + 3.0f * context.scale},
                im_packed(is_shown ? all[i].color : context.colors.dim));
        }
        tooltip(context, all[i].tip);
    }
    return chosen;
}

bool put_back() { return ImGui::IsItemClicked(ImGuiMouseButton_Right); }

void toggle(const Context& context, const char* label, bool& value, bool default_value, const char* tip) {
    const bool changed = value != default_value;
    if (changed) ImGui::PushStyleColor(ImGuiCol_Text, im_color(context.colors.changed));
    ImGui::Checkbox(label, &value);
    if (changed) ImGui::PopStyleColor();
    if (put_back()) value = default_value;
    tooltip(context, std::string(tip) + (changed ? "\nChanged; right click puts it back." : ""));
}

bool choice(const Context& context, const char* label, int& value, int default_value,
            std::span<const char* const> names, const char* tip) {
    const bool changed = value != default_value;
    if (changed) ImGui::PushStyleColor(ImGuiCol_Text, im_color(context.colors.changed));
    const int old = value;
    ImGui::Combo(label, &value, names.data(), static_cast<int>(names.size()));
    if (changed) ImGui::PopStyleColor();
    if (put_back()) value = default_value;
    tooltip(context, std::string(tip) + (changed ? "\nChanged; right click puts it back." : ""));
    return value != old;
}

}  // namespace boxwood::panel
