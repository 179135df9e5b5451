#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "core/catalog/pipeline.h"
#include "tests/support/sanitized.h"

namespace boxwood {

/// Every reference maker with every builder of the catalog, and every transform on every builder that it
/// takes with whole boxes, and on one of them with pieces; not those that need an animated scene. Under a
/// sanitizer: every row of the catalog once.
inline std::vector<std::string> all_recipes() {
    std::vector<std::string> recipes;
    std::set<std::string> transformed;  // with these references: the transforms that have been used
    for (const CatalogEntry& references : reference_catalog()) {
        const bool is_whole = std::string(references.id) == kWholeReferences;
        transformed.clear();
        for (const CatalogEntry& builder : builder_catalog()) {
            const std::string text = std::string(references.id) + " > " + builder.id;
            if (!kIsSanitized || is_whole || std::string(builder.id) == "bvh-binned-sah")
                recipes.push_back(text);
            for (const CatalogEntry& transform : transform_catalog()) {
                if (std::string(transform.input) != builder.output || transform.make()->input_frame())
                    continue;
                const bool is_first = transformed.insert(transform.id).second;
                if (is_first ? is_whole || !kIsSanitized : is_whole && !kIsSanitized)
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
