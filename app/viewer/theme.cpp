#include "app/viewer/theme.h"

#include <imgui.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <string>

namespace boxwood {
namespace {

constexpr const char* kFontFolder = "/usr/share/fonts/truetype/dejavu/";
constexpr float kTextSize = 13.0f, kSmallSize = 11.0f;  // pixels at interface scale 1

// Latin, and the signs that panels use: superscripts, arrows, mathematical operators, a few shapes.
constexpr std::array<ImWchar, 13> kGlyphs{0x0020, 0x00ff, 0x2010, 0x2026, 0x2070, 0x2089, 0x2190,
                                          0x21ff, 0x2200, 0x22ff, 0x25a0, 0x25ff, 0};

void add_font(ImFontAtlas& atlas, const char* file, float size) {
    const std::string path = std::string(kFontFolder) + file;
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error) &&
        atlas.AddFontFromFileTTF(path.c_str(), size, nullptr, kGlyphs.data()) != nullptr) {
        return;
    }
    ImFontConfig config;
    config.SizePixels = size;
    atlas.AddFontDefault(&config);
}

struct Grey {
    float window, child, field, hovered, active, line, text, dim;
};

ImVec4 tinted(float grey, float alpha = 1.0f) { return {grey, grey + 0.006f, grey + 0.018f, alpha}; }

void set_colors(const Grey& grey, const ThemeColors& colors) {
    ImVec4* c = ImGui::GetStyle().Colors;
    const auto accent = [&](float alpha) {
        return ImVec4(colors.accent.x, colors.accent.y, colors.accent.z, alpha);
    };
    c[ImGuiCol_Text] = im_color(colors.text);
    c[ImGuiCol_TextDisabled] = im_color(colors.dim);
    c[ImGuiCol_WindowBg] = tinted(grey.window);
    c[ImGuiCol_ChildBg] = tinted(grey.child, 0.0f);
    c[ImGuiCol_PopupBg] = tinted(grey.child, 0.98f);
    c[ImGuiCol_Border] = tinted(grey.line);
    c[ImGuiCol_BorderShadow] = ImVec4(0.0f, 0.0f, 0.0f, 0.0f);
    c[ImGuiCol_FrameBg] = tinted(grey.field);
    c[ImGuiCol_FrameBgHovered] = tinted(grey.hovered);
    c[ImGuiCol_FrameBgActive] = tinted(grey.active);
    c[ImGuiCol_TitleBg] = c[ImGuiCol_TitleBgActive] = c[ImGuiCol_TitleBgCollapsed] = tinted(grey.child);
    c[ImGuiCol_MenuBarBg] = tinted(grey.child);
    c[ImGuiCol_ScrollbarBg] = tinted(grey.window, 0.0f);
    c[ImGuiCol_ScrollbarGrab] = tinted(grey.active);
    c[ImGuiCol_ScrollbarGrabHovered] = c[ImGuiCol_ScrollbarGrabActive] = tinted(grey.line);
    c[ImGuiCol_CheckMark] = accent(1.0f);
    c[ImGuiCol_SliderGrab] = accent(0.85f);
    c[ImGuiCol_SliderGrabActive] = accent(1.0f);
    c[ImGuiCol_Button] = tinted(grey.field);
    c[ImGuiCol_ButtonHovered] = tinted(grey.hovered);
    c[ImGuiCol_ButtonActive] = tinted(grey.active);
    c[ImGuiCol_Header] = accent(0.22f);
    c[ImGuiCol_HeaderHovered] = accent(0.32f);
    c[ImGuiCol_HeaderActive] = accent(0.42f);
    c[ImGuiCol_Separator] = tinted(grey.line);
    c[ImGuiCol_TableHeaderBg] = tinted(grey.child);
    c[ImGuiCol_TableBorderStrong] = c[ImGuiCol_TableBorderLight] = tinted(grey.line, 0.6f);
    c[ImGuiCol_TableRowBg] = ImVec4(0.0f, 0.0f, 0.0f, 0.0f);
    c[ImGuiCol_TableRowBgAlt] = tinted(grey.field, 0.35f);
    c[ImGuiCol_TextSelectedBg] = accent(0.35f);
    c[ImGuiCol_NavHighlight] = accent(0.8f);
    c[ImGuiCol_PlotHistogram] = accent(0.9f);
}

}  // namespace

const ThemeColors& theme_colors(Theme theme) {
    static const ThemeColors kDark{
        .text = {0.90f, 0.91f, 0.93f, 1.0f},
        .dim = {0.60f, 0.62f, 0.66f, 1.0f},
        .accent = {0.36f, 0.66f, 0.95f, 1.0f},
        .changed = {0.96f, 0.75f, 0.33f, 1.0f},
        .good = {0.47f, 0.80f, 0.55f, 1.0f},
        .error = {1.00f, 0.52f, 0.44f, 1.0f},
        .red = {0.95f, 0.30f, 0.24f, 1.0f},
        .panel = {0.115f, 0.121f, 0.135f, 1.0f},
        .view_label = {0.93f, 0.94f, 0.96f, 1.0f},
    };
    static const ThemeColors kLight{
        .text = {0.11f, 0.12f, 0.14f, 1.0f},
        .dim = {0.37f, 0.39f, 0.43f, 1.0f},
        .accent = {0.10f, 0.42f, 0.76f, 1.0f},
        .changed = {0.62f, 0.38f, 0.00f, 1.0f},
        .good = {0.10f, 0.45f, 0.20f, 1.0f},
        .error = {0.74f, 0.13f, 0.08f, 1.0f},
        .red = {0.82f, 0.16f, 0.12f, 1.0f},
        .panel = {0.955f, 0.96f, 0.97f, 1.0f},
        .view_label = {0.10f, 0.11f, 0.13f, 1.0f},
    };
    return theme == Theme::Dark ? kDark : kLight;
}

ImVec4 im_color(const Vec4& color) { return {color.x, color.y, color.z, color.w}; }

uint32_t im_packed(const Vec4& color) { return ImGui::ColorConvertFloat4ToU32(im_color(color)); }

uint32_t im_packed(const Vec3& srgb) { return im_packed(Vec4(srgb, 1.0f)); }

float clear_grey(Theme theme) { return theme == Theme::Dark ? 0.12f : 0.95f; }

void set_style(Theme theme, float scale) {
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle();
    style.WindowPadding = {10.0f, 8.0f};
    style.FramePadding = {6.0f, 2.0f};
    style.ItemSpacing = {6.0f, 4.0f};
    style.ItemInnerSpacing = {5.0f, 4.0f};
    style.CellPadding = {4.0f, 2.0f};
    style.IndentSpacing = 14.0f;
    style.ScrollbarSize = 11.0f;
    style.GrabMinSize = 10.0f;
    style.FrameRounding = 3.0f;
    style.GrabRounding = 3.0f;
    style.PopupRounding = 4.0f;
    style.ScrollbarRounding = 4.0f;
    style.WindowRounding = 0.0f;
    style.WindowBorderSize = 0.0f;
    style.PopupBorderSize = 1.0f;
    style.ScaleAllSizes(scale);
    constexpr Grey kDark{0.115f, 0.14f, 0.19f, 0.235f, 0.28f, 0.30f, 0.9f, 0.6f};
    constexpr Grey kLight{0.955f, 0.975f, 0.885f, 0.84f, 0.79f, 0.76f, 0.1f, 0.4f};
    set_colors(theme == Theme::Dark ? kDark : kLight, theme_colors(theme));
}

void set_fonts(ImFontAtlas& atlas, float scale) {
    atlas.Clear();
    add_font(atlas, "DejaVuSans.ttf", std::round(kTextSize * scale));
    add_font(atlas, "DejaVuSans.ttf", std::round(kSmallSize * scale));
    add_font(atlas, "DejaVuSans-Bold.ttf", std::round(kTextSize * scale));
}

}  // namespace boxwood
