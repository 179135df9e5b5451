#include "core/measure/ray_file.h"

#include <array>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "core/base/error.h"
#include "core/scene/scene.h"

namespace boxwood {
namespace {

constexpr size_t kNumbers = 8;
constexpr std::array<const char*, kNumbers> kNames = {"ox", "oy", "oz", "dx", "dy", "dz", "tmin", "tmax"};

[[noreturn]] void refuse(const std::string& place, const std::string& sentence) {
    throw Error(ExitCode::BadInput, place + ": " + sentence);
}

/// Splits off the first word; empty at the end of the line.
std::string_view next_word(std::string_view& line) {
    const size_t begin = line.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) {
        line = {};
        return {};
    }
    const size_t end = line.find_first_of(" \t\r", begin);
    const std::string_view word = line.substr(begin, end - begin);
    line.remove_prefix(end == std::string_view::npos ? line.size() : end);
    return word;
}

float number_from(std::string_view word, size_t index, const std::string& place) {
    const std::string text(word);
    char* end = nullptr;
    errno = 0;
    const float value = std::strtof(text.c_str(), &end);
    if (end != text.c_str() + text.size())
        refuse(place, std::string(kNames[index]) + " is \"" + to_utf8(text) + "\", expected a number");
    if (errno == ERANGE && std::isinf(value))
        refuse(place, std::string(kNames[index]) + " is " + text + ", which no float holds");
    return value;
}

Ray ray_from(const std::array<float, kNumbers>& n, const std::string& place) {
    if (!(n[6] >= 0.0f)) {
        char text[32];
        std::snprintf(text, sizeof(text), "%g", static_cast<double>(n[6]));
        refuse(place, "tmin is " + std::string(text) +
                          ", expected 0 or more: a ray begins at its origin or behind it");
    }
    return {{n[0], n[1], n[2]}, n[6], {n[3], n[4], n[5]}, n[7]};
}

std::array<float, kNumbers> numbers_of(const Ray& ray) {
    return {ray.origin.x,    ray.origin.y,    ray.origin.z, ray.direction.x,
            ray.direction.y, ray.direction.z, ray.t_min,    ray.t_max};
}

}  // namespace

RayFile parse_rays(std::string_view text, const std::string& name) {
    RayFile file;
    for (size_t line_number = 1; !text.empty(); ++line_number) {
        const size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        const std::string_view id = next_word(line);
        if (id.empty() || id.front() == '#') continue;
        const std::string place = name + ", line " + std::to_string(line_number);
        std::array<float, kNumbers> numbers{};
        for (size_t i = 0; i < kNumbers; ++i) {
            const std::string_view word = next_word(line);
            if (word.empty())
                refuse(place,
                       std::string(kNames[i]) + " is missing, expected: id ox oy oz dx dy dz tmin tmax");
            numbers[i] = number_from(word, i, place);
        }
        if (const std::string_view more = next_word(line); !more.empty())
            refuse(place, "\"" + to_utf8(std::string(more)) +
                              "\" is one word too many, expected: id ox oy oz dx dy dz tmin tmax");
        file.ids.emplace_back(id);
        file.rays.push_back(ray_from(numbers, place));
    }
    return file;
}

RayFile parse_binary_rays(std::string_view bytes, const std::string& name) {
    constexpr size_t kRayBytes = kNumbers * sizeof(float);
    if (bytes.size() % kRayBytes != 0)
        refuse(name, std::to_string(bytes.size()) + " bytes, expected a multiple of 32: 8 float32 a ray");
    RayFile file;
    for (size_t ray = 0; ray < bytes.size() / kRayBytes; ++ray) {
        std::array<float, kNumbers> numbers{};
        for (size_t i = 0; i < kNumbers; ++i) {
            uint32_t bits = 0;
            for (size_t byte = 0; byte < sizeof(float); ++byte)
                bits |=
                    uint32_t{static_cast<unsigned char>(bytes[ray * kRayBytes + i * sizeof(float) + byte])}
                    << (8 * byte);
            numbers[i] = std::bit_cast<float>(bits);
        }
        file.ids.push_back(std::to_string(ray));
        file.rays.push_back(ray_from(numbers, name + ", ray " + std::to_string(ray)));
    }
    return file;
}

std::string ray_line(const std::string& id, const Ray& ray) {
    std::string line = id;
    for (const float number : numbers_of(ray)) {
        char text[48];
        std::snprintf(text, sizeof(text), " %a", static_cast<double>(number));
        line += text;
    }
    return line;
}

std::string hit_lines(const RayFile& file, std::span<const Hit> hits, const Mesh& mesh) {
    std::string text;
    for (size_t i = 0; i < hits.size(); ++i) {
        char t[32];
        const char* const end = std::to_chars(t, t + sizeof(t), hits[i].t).ptr;
        text += file.ids[i] + " ";
        text += hits[i].is_hit() ? std::to_string(mesh.source_prim[hits[i].prim]) : "-1";
        text += " ";
        text += std::string_view(t, static_cast<size_t>(end - t));
        text += "\n";
    }
    return text;
}

}  // namespace boxwood
