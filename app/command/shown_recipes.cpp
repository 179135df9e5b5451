#include "app/command/shown_recipes.h"

#include "core/base/error.h"
#include "core/catalog/recipe.h"

namespace boxwood {

void show_recipes(const std::vector<std::string>& texts, ViewerState& state) {
    if (texts.size() > state.sides.size()) {
        throw Error(ExitCode::WrongUsage, "--recipe: " + std::to_string(texts.size()) +
                                              " recipes, expected one, or two that are compared");
    }
    if (texts.empty()) return;
    for (size_t side = 0; side < state.sides.size(); ++side) {
        const std::string recipe = side < texts.size() ? print(parse_recipe(texts[side])) : std::string();
        if (recipe != state.sides[side].recipe) state.sides[side] = SideState{.recipe = recipe};
    }
}

}  // namespace boxwood
