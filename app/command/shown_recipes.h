#pragma once

#include <string>
#include <vector>

#include "app/viewer/state.h"

namespace boxwood {

inline constexpr const char* kShownRecipesHelp =
    "such as \"evh(t=16) > bvh-sweep-sah\"; given twice: A and B, compared in one picture";

/// The recipes of the command line in place of the state's: none leaves both, one is A's alone, two are A's
/// and B's. Throws Error (WrongUsage) for more, and for what is no recipe.
void show_recipes(const std::vector<std::string>& texts, ViewerState& state);

}  // namespace boxwood
