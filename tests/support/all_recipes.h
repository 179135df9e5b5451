#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/catalog/pipeline.h"

namespace boxwood {

/// Every reference maker with every builder of the catalog, and every transform on what it takes; not those
/// that need an animated scene.
inline std::vector<std::string> all_recipes() {
    std::vector<std::string> recipes;
    for (const CatalogEntry& references : reference_catalog()) {
        for (const CatalogEntry& builder : builder_catalog()) {
            const std::string text = std::string(references.id) + " > " + builder.id;
            recipes.push_back(text);
            for (const CatalogEntry& transform : transform_catalog()) {
                if (std::string(transform.input) == builder.output && !transform.make()->input_frame())
                    recipes.push_back(text + " > " + transform.id);
            }
        }
    }
    return recipes;
}

/// The recipe over the mesh, with nothing kept from before.
inline Built run(const std::string& recipe, const Mesh& mesh) {
    auto scene = std::make_shared<Scene>();
    scene->mesh = mesh;
    StageCache cache;
    Task task;
    return run_recipe(parse_recipe(recipe), scene, cache, task, /*with_levels=*/true).value();
}

}  // namespace boxwood
