#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/structure/method.h"

namespace boxwood {

/// One parameter as a recipe writes it: "t", "12".
struct ParamText {
    std::string key, value;

    bool operator==(const ParamText&) const = default;
};

/// One parameter as help and `boxwood list` show it.
struct ParamInfo {
    std::vector<std::string> keys;  ///< one; two where either may be given, but not both
    std::string kind;               ///< "int", "float", "bool", "enum", "area limit"
    std::string range;              ///< "0 to 40", "on or off", "a, b or c"
    std::string initial;            ///< its value as a recipe writes it: "t=14"
    std::string help;
};

/// Sets the given parameters of a stage. Throws Error (WrongUsage) for an unknown key (naming the nearest), a
/// key given twice or together with the one it excludes, a value of another type or outside its range.
/// `stage` is the id that messages name.
void set_params(StageMethod& method, const std::string& stage, std::span<const ParamText> given);

/// All parameters with their values, in the order of `describe`; numbers in the shortest form that reads back
/// as the same value.
std::vector<ParamText> param_texts(const StageMethod& method);

std::vector<ParamInfo> param_infos(const StageMethod& method);

}  // namespace boxwood
