#pragma once

#include <cstddef>
#include <vector>

namespace boxwood {

/// A real number as the exact sum of doubles: components do not overlap, in ascending magnitude, none zero;
/// no component is zero. Sums and products are exact as long as no bit lies below 2^-1074 and nothing
/// overflows, which holds for polynomials of up to six float factors (2^-149 and 2^128 each). Shewchuk,
/// "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", Discrete &
/// Computational Geometry 18, 1997, sections 2.4 to 2.6.
class Expansion {
public:
    Expansion() = default;
    explicit Expansion(double value) {
        if (value != 0.0) parts_.push_back(value);
    }
    /// a - b, exact.
    static Expansion difference(double a, double b);

    Expansion operator+(const Expansion& other) const;
    Expansion operator-(const Expansion& other) const { return *this + -other; }
    Expansion operator-() const;
    Expansion operator*(double factor) const;
    Expansion operator*(const Expansion& other) const;

    /// -1, 0 or 1.
    int sign() const { return parts_.empty() ? 0 : parts_.back() > 0.0 ? 1 : -1; }
    /// The sum, rounded once but for a relative error below 2^-80: the roundings of a sum from small to large
    /// are summed too (Ogita, Rump, Oishi, "Accurate Sum and Dot Product", SIAM J. Sci. Comput. 26(6), 2005,
    /// proposition 4.4: u|s| + (nu)^2 times the sum of |parts|, which is below 8|s| as the parts of sums and
    /// products are strongly nonoverlapping).
    double estimate() const;

private:
    std::vector<double> parts_;
};

}  // namespace boxwood
