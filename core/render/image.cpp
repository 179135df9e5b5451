#include "core/render/image.h"

#include <array>

namespace boxwood {

namespace {

/// x^(1/5) for x in (0, 1] by Newton's method; only basic operations, so every compiler gets the same bits.
constexpr double fifth_root(double x) {
    double y = 1.0;
    for (int i = 0; i < 60; ++i) y = 0.2 * (4.0 * y + x / (y * y * y * y));
    return y;
}

/// IEC 61966-2-1: linear value of an sRGB component in [0, 1].
constexpr double decode_srgb(double s) {
    if (s <= 0.04045) return s / 12.92;
    const double base = (s + 0.055) / 1.055;
    return base * base * fifth_root(base * base);  // base^2.4 = base^2 base^(2/5)
}

constexpr std::array<float, 256> make_linear_table() {
    std::array<float, 256> table{};
    for (size_t i = 0; i < 256; ++i)
        table[i] = static_cast<float>(decode_srgb(static_cast<double>(i) / 255.0));
    return table;
}

/// Entry i: the least linear value whose byte is i.
constexpr std::array<float, 256> make_threshold_table() {
    std::array<float, 256> table{};
    for (size_t i = 1; i < 256; ++i)
        table[i] = static_cast<float>(decode_srgb((static_cast<double>(i) - 0.5) / 255.0));
    return table;
}

constexpr std::array<float, 256> kLinear = make_linear_table();
constexpr std::array<float, 256> kThreshold = make_threshold_table();

/// Entry i: the byte of i / 1024, where the search for a linear value in that cell begins.
constexpr size_t kCellCount = 1024;
constexpr std::array<uint8_t, kCellCount + 1> make_first_byte_table() {
    std::array<uint8_t, kCellCount + 1> table{};
    size_t byte = 0;
    for (size_t i = 0; i <= kCellCount; ++i) {
        const float linear = static_cast<float>(i) / static_cast<float>(kCellCount);
        while (byte < 255 && linear >= kThreshold[byte + 1]) ++byte;
        table[i] = static_cast<uint8_t>(byte);
    }
    return table;
}
constexpr std::array<uint8_t, kCellCount + 1> kFirstByte = make_first_byte_table();

uint8_t nearest_byte(float x) {
    if (!(x > 0.0f)) return 0;
    return x >= 1.0f ? uint8_t{255} : static_cast<uint8_t>(x * 255.0f + 0.5f);
}

}  // namespace

Image::Image(int image_width, int image_height) : width(image_width), height(image_height) {
    rgba.assign(4 * pixel_count(), 0);
    for (size_t i = 3; i < rgba.size(); i += 4) rgba[i] = 255;
}

uint8_t srgb_byte(float linear) {
    if (!(linear > 0.0f)) return 0;
    if (linear >= 1.0f) return 255;
    size_t byte = kFirstByte[static_cast<size_t>(linear * static_cast<float>(kCellCount))];
    while (byte < 255 && linear >= kThreshold[byte + 1]) ++byte;
    return static_cast<uint8_t>(byte);
}

float linear_from_srgb(uint8_t byte) { return kLinear[byte]; }

Vec3 linear_from_srgb(const Vec3& srgb) {
    return {kLinear[nearest_byte(srgb.x)], kLinear[nearest_byte(srgb.y)], kLinear[nearest_byte(srgb.z)]};
}

Vec3 srgb_from_linear(const Vec3& linear) {
    return Vec3(static_cast<float>(srgb_byte(linear.x)), static_cast<float>(srgb_byte(linear.y)),
                static_cast<float>(srgb_byte(linear.z))) /
           255.0f;
}

void store_srgb(const Vec3& srgb, uint8_t* rgba) {
    const Vec3 bytes = srgb * 255.0f + 0.5f;
    rgba[0] = static_cast<uint8_t>(bytes.x);
    rgba[1] = static_cast<uint8_t>(bytes.y);
    rgba[2] = static_cast<uint8_t>(bytes.z);
    rgba[3] = 255;
}

void store_linear(const Vec3& linear, uint8_t* rgba) {
    rgba[0] = srgb_byte(linear.x);
    rgba[1] = srgb_byte(linear.y);
    rgba[2] = srgb_byte(linear.z);
    rgba[3] = 255;
}

}  // namespace boxwood
