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

/// The three tables.
std::span<const CatalogEntry> reference_catalog();
std::span<const CatalogEntry> builder_catalog();
std::span<const CatalogEntry> transform_catalog();

/// The row of that id in any table, or nullptr.
const CatalogEntry* find_entry(const std::string& id);

}  // namespace boxwood
