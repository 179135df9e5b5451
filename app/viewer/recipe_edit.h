#pragma once

#include <optional>
#include <string>

#include "core/catalog/recipe.h"

namespace boxwood {

/// Whether every transform takes what comes before it.
bool all_fit(const Recipe& recipe);

/// Whether a transform takes what the builder and the first `count` transforms make.
bool fits_after(const Recipe& recipe, size_t count, const CatalogEntry& entry);

/// Takes the transforms out that do not fit what comes before them; a sentence for each, in lines.
std::string drop_misfits(Recipe& recipe);

/// With a transform of that row, its parameters the defaults, before the one at `place`; place up to the
/// number of transforms.
Recipe with_inserted(Recipe recipe, size_t place, const CatalogEntry& entry);

/// With the transforms at `place` and place + 1 in the other order.
Recipe with_swapped(Recipe recipe, size_t place);

/// The last place at which a transform fits so that all after it still do.
std::optional<size_t> place_for(const Recipe& recipe, const CatalogEntry& entry);

}  // namespace boxwood
