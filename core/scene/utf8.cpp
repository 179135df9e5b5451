#include <cstdint>

#include "core/scene/scene.h"

namespace boxwood {
namespace {

/// Length in bytes of the well-formed sequence at `at`; 0 if there is none. The Unicode Standard, table 3-7.
size_t sequence_length(const std::string& text, size_t at) {
    const auto byte = [&text](size_t i) -> unsigned {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const auto continues = [&byte](size_t i) { return (byte(i) & 0xc0u) == 0x80u; };
    const unsigned first = byte(at), second = byte(at + 1);
    if (first < 0x80u) return 1;
    if (first >= 0xc2u && first <= 0xdfu) return continues(at + 1) ? 2 : 0;
    if (first >= 0xe0u && first <= 0xefu) {
        if (first == 0xe0u && second < 0xa0u) return 0;  // overlong
        if (first == 0xedu && second > 0x9fu) return 0;  // surrogates
        return continues(at + 1) && continues(at + 2) ? 3 : 0;
    }
    if (first >= 0xf0u && first <= 0xf4u) {
        if (first == 0xf0u && second < 0x90u) return 0;  // overlong
        if (first == 0xf4u && second > 0x8fu) return 0;  // above U+10FFFF
        return continues(at + 1) && continues(at + 2) && continues(at + 3) ? 4 : 0;
    }
    return 0;
}

}  // namespace

std::string to_utf8(const std::string& text) {
    std::string result;
    result.reserve(text.size());
    for (size_t at = 0; at < text.size();) {
        const size_t length = sequence_length(text, at);
        if (length == 0) {
            result += "\xef\xbf\xbd";
            ++at;
        } else {
            result.append(text, at, length);
            at += length;
        }
    }
    return result;
}

}  // namespace boxwood
