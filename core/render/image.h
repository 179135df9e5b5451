#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/vec.h"

namespace boxwood {

/// Picture of 8-bit sRGB pixels with alpha, row-major, row 0 on top: rgba.size() == 4 * width * height.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<uint8_t> rgba;

    Image() = default;
    /// Every pixel opaque black.
    Image(int width, int height);

    size_t pixel_count() const { return static_cast<size_t>(width) * static_cast<size_t>(height); }
    uint8_t* pixel(int x, int y) { return rgba.data() + 4 * index(x, y); }
    const uint8_t* pixel(int x, int y) const { return rgba.data() + 4 * index(x, y); }
    bool operator==(const Image&) const = default;

private:
    size_t index(int x, int y) const {
        return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
    }
};

/// The sRGB byte nearest to a linear value; below 0 and NaN give 0, above 1 gives 255. The same on every
/// compiler: no library function decides.
uint8_t srgb_byte(float linear);

/// Linear value in [0, 1] of an sRGB byte.
float linear_from_srgb(uint8_t byte);

/// Linear RGB of sRGB components in [0, 1] (to the nearest byte).
Vec3 linear_from_srgb(const Vec3& srgb);

/// sRGB components in [0, 1] (to the nearest byte) of linear RGB.
Vec3 srgb_from_linear(const Vec3& linear);

/// Writes an opaque pixel from sRGB components in [0, 1].
void store_srgb(const Vec3& srgb, uint8_t* rgba);

/// Writes an opaque pixel from linear RGB.
void store_linear(const Vec3& linear, uint8_t* rgba);

}  // namespace boxwood
