#pragma once

#include <string>

namespace boxwood {

/// A family with its article: "a binary BVH", "an oriented box BVH", "an 8-wide BVH".
inline std::string with_article(const std::string& family) {
    const bool has_vowel = !family.empty() && std::string("aeiou8").find(family[0]) != std::string::npos;
    return (has_vowel ? "an " : "a ") + family;
}

}  // namespace boxwood
