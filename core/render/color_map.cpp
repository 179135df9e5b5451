#include "core/render/color_map.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/render/image.h"

namespace boxwood {

namespace {

/// sRGB bytes.
struct Rgb {
    uint8_t r, g, b;
};

/// Smith and van der Walt, "A Better Default Colormap for Matplotlib", SciPy 2015; every 16th of its colours.
constexpr Rgb kViridis[] = {{68, 1, 84},    {72, 24, 106},  {71, 45, 123},  {66, 64, 134},  {59, 82, 139},
                            {51, 99, 141},  {44, 114, 142}, {38, 129, 142}, {33, 144, 140}, {31, 159, 136},
                            {40, 174, 128}, {62, 188, 116}, {93, 201, 99},  {130, 211, 76}, {171, 220, 50},
                            {213, 226, 26}, {253, 231, 37}};

/// Nuñez, Anderton, Renslow, "Optimizing colormaps with consideration for color vision deficiency", PLOS ONE
/// 2018; every 16th of its colours.
constexpr Rgb kCividis[] = {
    {0, 34, 78},     {0, 46, 106},    {26, 56, 111},   {50, 67, 109},   {67, 78, 108},   {82, 89, 109},
    {97, 101, 111},  {111, 112, 115}, {124, 123, 120}, {139, 135, 120}, {155, 147, 118}, {171, 160, 114},
    {187, 173, 108}, {204, 186, 100}, {221, 201, 88},  {239, 215, 72},  {254, 232, 56}};

/// Crameri, Shephard, Heron, "The misuse of colour in science communication", Nature Communications 2020;
/// every eighth of batlow's range.
constexpr Rgb kBatlow[] = {{1, 25, 89},    {17, 67, 96},    {34, 96, 97},    {77, 115, 77},  {130, 130, 49},
                           {192, 144, 54}, {241, 157, 107}, {253, 180, 180}, {250, 204, 250}};

/// From the middle outwards. The light one: Harrower and Brewer, "ColorBrewer.org: An Online Tool for
/// Selecting Colour Schemes for Maps", The Cartographic Journal 2003: the blue of RdBu, the orange of PuOr.
/// The dark one has the same hues, and as many steps of brightness on both sides.
constexpr Rgb kLightBlue[] = {{247, 247, 247}, {209, 229, 240}, {146, 197, 222},
                              {67, 147, 195},  {33, 102, 172},  {5, 48, 97}};
constexpr Rgb kLightOrange[] = {{247, 247, 247}, {254, 224, 182}, {253, 184, 99},
                                {224, 130, 20},  {179, 88, 6},    {127, 59, 8}};
constexpr Rgb kDarkBlue[] = {{34, 35, 38},   {26, 62, 102},   {36, 97, 164},
                             {66, 141, 214}, {132, 190, 245}, {214, 236, 255}};
constexpr Rgb kDarkOrange[] = {{34, 35, 38},   {92, 52, 18},   {150, 82, 14},
                               {208, 122, 24}, {246, 178, 86}, {255, 234, 196}};

/// Okabe and Ito's colours, the grey in place of black, in an order in which neighbours differ in hue and
/// brightness.
constexpr Rgb kPalette[] = {{86, 180, 233}, {230, 159, 0}, {0, 158, 115},   {204, 121, 167},
                            {240, 228, 66}, {0, 114, 178}, {153, 153, 153}, {213, 94, 0}};

Vec3 components(const Rgb& c) {
    return Vec3(static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)) / 255.0f;
}

std::span<const Rgb> table_of(ColorMap map) {
    switch (map) {
        case ColorMap::Cividis:
            return kCividis;
        case ColorMap::Batlow:
            return kBatlow;
        case ColorMap::Viridis:
            break;
    }
    return kViridis;
}

/// Between the table's colours; x as for map_srgb.
Vec3 interpolated(std::span<const Rgb> table, float x) {
    if (!(x > 0.0f)) return components(table.front());
    if (x >= 1.0f) return components(table.back());
    const float position = x * static_cast<float>(table.size() - 1);
    const size_t i = std::min(static_cast<size_t>(position), table.size() - 2);
    const float f = position - static_cast<float>(i);
    return components(table[i]) * (1.0f - f) + components(table[i + 1]) * f;
}

}  // namespace

Vec3 map_srgb(ColorMap map, float x) { return interpolated(table_of(map), x); }

Vec3 diverging_srgb(float x, bool dark_middle) {
    const std::span<const Rgb> above = dark_middle ? kDarkOrange : kLightOrange;
    return x < 0.0f ? interpolated(dark_middle ? kDarkBlue : kLightBlue, -x) : interpolated(above, x);
}

Vec3 map_linear(ColorMap map, float x) { return linear_from_srgb(map_srgb(map, x)); }

Vec3 palette_srgb(uint32_t i) {
    constexpr uint32_t kSize = static_cast<uint32_t>(std::size(kPalette));
    const Vec3 color = components(kPalette[i % kSize]);
    switch (i / kSize % 3) {
        case 1:
            return color * 0.55f + 0.45f;  // lighter
        case 2:
            return color * 0.6f;  // darker
        default:
            return color;
    }
}

Vec3 palette_linear(uint32_t i) { return linear_from_srgb(palette_srgb(i)); }

float ValueScale::position(double value) const {
    if (!(value > lower)) return 0.0f;
    if (!(upper > lower) || value >= upper) return 1.0f;
    const double p =
        logarithmic ? std::log(value / lower) / std::log(upper / lower) : (value - lower) / (upper - lower);
    return static_cast<float>(std::clamp(p, 0.0, 1.0));
}

double ValueScale::value(double position) const {
    const double p = std::clamp(position, 0.0, 1.0);
    return logarithmic ? lower * std::pow(upper / lower, p) : lower + (upper - lower) * p;
}

}  // namespace boxwood
