#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/catalog/catalog.h"

namespace boxwood {

/// The references of a recipe that names none.
inline constexpr const char* kWholeReferences = "whole";

/// One stage of a recipe: a catalog row and its parameters. A value: copies are independent.
class Stage {
public:
    explicit Stage(const CatalogEntry& entry);
    Stage(const Stage& other);
    Stage& operator=(const Stage& other);
    Stage(Stage&&) noexcept = default;
    Stage& operator=(Stage&&) noexcept = default;

    const CatalogEntry& entry() const { return *entry_; }
    StageMethod& method() { return *method_; }
    const StageMethod& method() const { return *method_; }
    /// "evh(t=12)"; what equals its default is left out, also the brackets.
    std::string text() const;
    bool operator==(const Stage& other) const { return text() == other.text(); }

private:
    const CatalogEntry* entry_;
    std::unique_ptr<StageMethod> method_;
};

/// One way through the pipeline: references > builder > transforms. `references` is always present ("whole"
/// if the text left it out; print leaves `whole` out).
struct Recipe {
    Stage references;
    Stage builder;
    std::vector<Stage> transforms;

    bool operator==(const Recipe&) const = default;
};

/// Throws Error (WrongUsage) that says what is wrong and names the nearest valid stage or key, or both
/// families where a transform does not fit: "wide8 needs a binary BVH, kd-sah makes a kd-tree".
Recipe parse_recipe(const std::string& text);
/// The same over other tables than Boxwood's own; they outlive the recipe.
Recipe parse_recipe(const std::string& text, const Catalog& catalog);

/// Canonical: parse_recipe(print(r)) == r.
std::string print(const Recipe& recipe);

/// The recipe whose structure may be shown until that of this one is there (see HasStandIn): another builder,
/// with its defaults. Nothing where the builder has no stand-in.
std::optional<Recipe> stand_in(const Recipe& recipe);

/// The canonical text of the first `stage_count` stages (1: references), for the cache.
std::string prefix(const Recipe& recipe, size_t stage_count);

}  // namespace boxwood
