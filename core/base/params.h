#pragma once

#include <span>

namespace boxwood {

/// A limit on a box's surface area, given either relative to the scene's box or in square world units.
/// Ernst, Greiner 2007, section 5: SA_max; relative as S / 2^s, S the surface area of the scene's box.
struct AreaLimit {
    bool absolute = false;  ///< false: value is s; true: value is sa, in square world units
    double value = 10.0;

    /// SA_max in square world units: `value` itself, or scene_area / 2^value.
    double max_area(double scene_area) const;
    bool operator==(const AreaLimit&) const = default;
};

/// Walks a stage's parameters: the parser, the printer, the panel's sliders and the reports are visitors.
/// A value outside its range is clamped by none of them but refused.
class ParamVisitor {
public:
    virtual ~ParamVisitor() = default;
    virtual void on_int(const char* key, int& value, int lower, int upper, const char* help) = 0;
    virtual void on_float(const char* key, float& value, float lower, float upper, const char* help) = 0;
    virtual void on_bool(const char* key, bool& value, const char* help) = 0;
    /// value indexes names.
    virtual void on_enum(const char* key, int& value, std::span<const char* const> names,
                         const char* help) = 0;
    /// Two keys of which at most one is given: `s` (relative, 0 to 40) or `sa` (absolute, above 0).
    virtual void on_area_limit(const char* relative_key, const char* absolute_key, AreaLimit& value,
                               const char* help) = 0;
};

}  // namespace boxwood
