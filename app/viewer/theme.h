#pragma once

#include "app/viewer/state.h"

struct ImFontAtlas;
struct ImVec4;

namespace boxwood {

/// Colours of the interface beyond those of Dear ImGui's style, sRGB.
struct ThemeColors {
    Vec4 text, dim, accent, changed, good, error, red, panel, view_label;
};

const ThemeColors& theme_colors(Theme theme);
ImVec4 im_color(const Vec4& color);
/// Packed for draw lists.
uint32_t im_packed(const Vec4& color);
uint32_t im_packed(const Vec3& srgb);

/// Grey, sRGB-coded, of the frame behind everything.
float clear_grey(Theme theme);

/// Sets colours, sizes and roundings of the current Dear ImGui context.
void set_style(Theme theme, float scale);

/// Fills the atlas for an interface scale: DejaVu Sans where it is installed, otherwise Dear ImGui's own
/// font. First font: text; second: small; third: the text's bold.
void set_fonts(ImFontAtlas& atlas, float scale);

}  // namespace boxwood
