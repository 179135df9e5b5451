#pragma once

#include <gtest/gtest.h>

#include <cctype>
#include <string>

namespace boxwood {

/// Of a test whose parameter is a text: GoogleTest allows letters, digits and _ alone.
inline std::string test_name(const testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    for (char& c : name) {
        if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    }
    return name;
}

}  // namespace boxwood
