#include "app/viewer/recipe_edit.h"
#include "core/catalog/family_text.h"

#include <string_view>
#include <utility>

namespace boxwood {
namespace {

/// Family of what the builder and the first `count` transforms make.
const char* family_after(const Recipe& recipe, size_t count) {
    return count == 0 ? recipe.builder.entry().output : recipe.transforms[count - 1].entry().output;
}

/// The first transform that does not fit; the number of transforms if all do.
size_t first_misfit(const Recipe& recipe) {
    for (size_t i = 0; i < recipe.transforms.size(); ++i)
        if (!fits_after(recipe, i, recipe.transforms[i].entry())) return i;
    return recipe.transforms.size();
}

}  // namespace

bool fits_after(const Recipe& recipe, size_t count, const CatalogEntry& entry) {
    return std::string_view(entry.input) == family_after(recipe, count);
}

bool all_fit(const Recipe& recipe) { return first_misfit(recipe) == recipe.transforms.size(); }

std::string drop_misfits(Recipe& recipe) {
    std::string note;
    for (size_t i = first_misfit(recipe); i < recipe.transforms.size(); i = first_misfit(recipe)) {
        const CatalogEntry& entry = recipe.transforms[i].entry();
        note += (note.empty() ? "" : "\n") + std::string(entry.id) + " was taken out: it needs " +
                with_article(entry.input) + ", here is " + with_article(family_after(recipe, i)) + ".";
        recipe.transforms.erase(recipe.transforms.begin() + static_cast<std::ptrdiff_t>(i));
    }
    return note;
}

Recipe with_inserted(Recipe recipe, size_t place, const CatalogEntry& entry) {
    recipe.transforms.insert(recipe.transforms.begin() + static_cast<std::ptrdiff_t>(place), Stage(entry));
    return recipe;
}

Recipe with_swapped(Recipe recipe, size_t place) {
    std::swap(recipe.transforms[place], recipe.transforms[place + 1]);
    return recipe;
}

std::optional<size_t> place_for(const Recipe& recipe, const CatalogEntry& entry) {
    for (size_t place = recipe.transforms.size() + 1; place-- > 0;)
        if (all_fit(with_inserted(recipe, place, entry))) return place;
    return std::nullopt;
}

}  // namespace boxwood
