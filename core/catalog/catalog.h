#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/structure/method.h"

namespace boxwood {

enum class StageKind : uint8_t { References, Builder, Transform };

/// One row of the catalog: all that command line, panel, bench and tests know of a method.
struct CatalogEntry {
    const char* id;      ///< lower case, hyphens, never renamed
    const char* label;   ///< a few words for people
    const char* source;  ///< authors, year, section
    StageKind kind;
    const char* input;   ///< family that a transform takes; "" for the other kinds
    const char* output;  ///< family of the structure that comes out; "" for references
    bool exact;          ///< false: an approximate structure that reports its error
    std::unique_ptr<StageMethod> (*make)();
};

/// The row of method T; kind and families are read off its type.
template <class T>
constexpr CatalogEntry row(const char* id, const char* label, const char* source, bool exact = true) {
    const auto make = []() -> std::unique_ptr<StageMethod> { return std::make_unique<StageModel<T>>(); };
    if constexpr (Transform<T>) {
        return {id, label, source, StageKind::Transform, T::Input::kFamily, T::Output::kFamily, exact, make};
    } else if constexpr (Builder<T>) {
        using Output = decltype(std::declval<const T&>().build(
            std::declval<const Mesh&>(), std::declval<std::span<const PrimRef>>(), std::declval<Task&>()));
        return {id, label, source, StageKind::Builder, "", Output::kFamily, exact, make};
    } else {
        static_assert(ReferenceMaker<T>);
        return {id, label, source, StageKind::References, "", "", exact, make};
    }
}

/// The three tables. The first row of `references` is what a recipe has that names none: whole boxes.
struct Catalog {
    std::span<const CatalogEntry> references, builders, transforms;

    /// The row of that id in any table, or nullptr.
    const CatalogEntry* find(const std::string& id) const;
    /// Every id, in the order of the tables.
    std::vector<std::string> ids() const;
};

/// All that Boxwood has.
const Catalog& catalog();

std::span<const CatalogEntry> reference_catalog();
std::span<const CatalogEntry> builder_catalog();
std::span<const CatalogEntry> transform_catalog();

/// The row of that id in any table, or nullptr.
const CatalogEntry* find_entry(const std::string& id);

}  // namespace boxwood
