#pragma once

#include <array>
#include <cstdint>

#include "core/base/vec.h"

namespace boxwood {

/// Perceptual colour maps, dark to bright, that colour-blind eyes read too.
enum class ColorMap : uint8_t { Viridis, Cividis, Batlow };

/// By value of ColorMap.
inline constexpr std::array<const char*, 3> kColorMapNames = {"viridis", "cividis", "batlow"};

/// Colour at x, as sRGB components in [0, 1]. x is clamped to [0, 1]; NaN counts as 0.
Vec3 map_srgb(ColorMap map, float x);

/// The same as linear RGB.
Vec3 map_linear(ColorMap map, float x);

/// Colour of a signed value at x in [-1, 1], as sRGB components: blue below 0, orange above, colours that
/// colour-blind eyes tell apart, the farther from 0 the further from the middle's grey. The middle is dark or
/// light. x is clamped; NaN counts as 0.
Vec3 diverging_srgb(float x, bool dark_middle);

/// Colour of level or object i, as sRGB components: neighbours differ clearly, also for colour-blind eyes.
/// Okabe, Ito, "Color Universal Design", 2008; after eight colours they come again, lighter, then darker.
Vec3 palette_srgb(uint32_t i);

/// The same as linear RGB.
Vec3 palette_linear(uint32_t i);

/// Where values go on a colour map, and what its legend says.
struct ValueScale {
    double lower = 0.0;  ///< value of the map's first colour; logarithmic: above 0
    double upper = 1.0;  ///< value of the map's last colour
    bool logarithmic = false;

    /// Position of a value on the map, in [0, 1]: what lies outside the scale is clamped, NaN gives 0. A
    /// scale with upper <= lower gives 0 for all that is not above it, otherwise 1.
    float position(double value) const;
    /// The inverse: the value at a position in [0, 1], for the ticks of a legend.
    double value(double position) const;
    bool operator==(const ValueScale&) const = default;
};

}  // namespace boxwood
