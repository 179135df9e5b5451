#include "app/command/check_report.h"

#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/render/png.h"
#include "core/scene/scene.h"

namespace boxwood {
namespace {

std::string base64(const std::string& bytes) {
    static constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](size_t k) {
            return i + k < bytes.size() ? uint32_t{static_cast<uint8_t>(bytes[i + k])} : 0u;
        };
        const uint32_t bits = byte(0) << 16 | byte(1) << 8 | byte(2);
        for (uint32_t digit = 0; digit < 4; ++digit) {
            text += i + digit > bytes.size() ? '=' : kDigits[bits >> (18 - 6 * digit) & 63];
        }
    }
    return text;
}

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : to_utf8(text)) {
        if (c == '<') {
            result += "&lt;";
        } else if (c == '&') {
            result += "&amp;";
        } else {
            result += c;
        }
    }
    return result;
}

/// The picture as an <img> that carries it.
std::string picture(const Image& image, const char* caption) {
    if (image.pixel_count() == 0)
        return std::string("<figure><figcaption>no ") + caption + "</figcaption></figure>";
    const std::string path =
        (std::filesystem::temp_directory_path() / ("boxwood-check-" + std::to_string(getpid()) + ".png"))
            .string();
    write_png(path, image);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    std::filesystem::remove(path);
    return std::string("<figure><figcaption>") + caption + "</figcaption><img src=\"data:image/png;base64," +
           base64(bytes) + "\" alt=\"" + caption + "\"></figure>";
}

std::string section(const CheckRow& row) {
    return "<section class=\"" + std::string(row.passed ? "good" : "bad") + "\"><h2>" + escaped(row.name) +
           "</h2><p>" + escaped(verdict(row)) + "</p><div>" + picture(row.reference, "reference") +
           picture(row.result, "result") + picture(row.comparison.difference, "difference") +
           "</div></section>\n";
}

}  // namespace

std::string verdict(const CheckRow& row) {
    if (!row.problem.empty()) return row.problem;
    if (!row.comparison.same_size) return "the picture has another size";
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(),
                  "%llu pixels beyond %d (limit %d), largest %d, worst tile %.2f (limit %.2f)",
                  static_cast<unsigned long long>(row.comparison.different_pixels), row.limits.difference,
                  row.limits.pixels, row.comparison.largest_difference, row.comparison.largest_tile_mean,
                  row.limits.tile_mean);
    return text.data();
}

std::string check_page(const std::string& folder, const std::vector<CheckRow>& rows) {
    std::string page =
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>boxwood check</title><style>"
        "body{font:15px sans-serif;margin:2em;background:#fafafa;color:#222}"
        "div{display:flex;gap:1em;flex-wrap:wrap}figure{margin:0;flex:1 1 20em}img{width:100%;border:1px "
        "solid #bbb}"
        "section{border-left:6px solid;padding:0 1em;margin:1.5em 0}.good{border-color:#3a8a4d}"
        ".bad{border-color:#c23b22}h2{margin:0}p{margin:.3em 0}figcaption{color:#666}</style><h1>boxwood "
        "check " +
        escaped(folder) + "</h1>\n";
    for (const bool passed : {false, true}) {
        for (const CheckRow& row : rows) {
            if (row.passed == passed) page += section(row);
        }
    }
    return page + "</html>\n";
}

}  // namespace boxwood
