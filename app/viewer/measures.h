#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/viewer/panels.h"

namespace boxwood {

/// One number that a structure is judged by.
struct Measure {
    enum class Unit : uint8_t { Count, Bytes, Milliseconds, Rate, Number, Share };
    enum class Better : uint8_t { Lower, Higher, Neither };

    const char* key;   ///< in reports: those of boxwood stats where it has them
    const char* name;  ///< in the panel
    Unit unit = Unit::Count;
    Better better = Better::Neither;
    std::optional<double> value{};  ///< none: not known (yet)
    std::string tip{};              ///< what it is, with this scene's numbers
};

/// The measures of a side, always the same ones in the same order for one state; none without a structure.
std::vector<Measure> measures_of(const ViewerState& state, const PanelInput& input, Side side);

/// "12.3 MiB", "1.25 s", ...; a dash where there is no value.
std::string measure_text(Measure::Unit unit, const std::optional<double>& value);

/// A measure of both sides.
struct MeasurePair {
    Measure a, b;

    /// A - B; none where one is not known.
    std::optional<double> difference() const;
    /// The side that does better; none where both are equal, not known, or neither is better.
    std::optional<Side> winner() const;
};

/// Of lists for the same state; what only one has is left out.
std::vector<MeasurePair> pairs_of(const std::vector<Measure>& a, const std::vector<Measure>& b);

/// The pairs for other programs: measure, A, B, A - B, under the names of both recipes. Times in
/// milliseconds, sizes in bytes, shares of 1.
std::string measures_tsv(const std::vector<MeasurePair>& pairs);
std::string measures_markdown(const std::vector<MeasurePair>& pairs);
std::string measures_json(const std::vector<MeasurePair>& pairs, const std::string& recipe_a,
                          const std::string& recipe_b);

}  // namespace boxwood
