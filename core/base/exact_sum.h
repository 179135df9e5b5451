#pragma once

#include <array>
#include <cmath>

#include "core/base/assert.h"

namespace boxwood {

/// A difference of two floats without error: high + low.
struct ExactDifference {
    double high, low;

    ExactDifference(float a, float b) : high(double(a) - double(b)) {
        const double b_part = double(a) - high;
        const double a_part = high + b_part;
        low = (double(a) - a_part) + (b_part - double(b));
    }
};

/// Sum of doubles without error, as a nonoverlapping expansion in ascending order of magnitude, without
/// zeros. Holds for sums of products of up to four floats: the smallest unit is then 2^-596 and the largest
/// term below 2^512, far from the ends of double. Shewchuk, "Adaptive Precision Floating-Point Arithmetic and
/// Fast Robust Geometric Predicates", Discrete & Computational Geometry 1997, figure 6 (grow-expansion, with
/// zero elimination) and theorem 10.
class ExactSum {
public:
    void add(double x) {
        int kept = 0;
        for (int i = 0; i < size_; ++i) {
            const double term = terms_[index(i)];
            const double sum = x + term;
            const double term_part = sum - x;
            const double rest = (x - (sum - term_part)) + (term - term_part);
            x = sum;
            if (rest != 0.0) terms_[index(kept++)] = rest;
        }
        if (x != 0.0) {
            BOXWOOD_ASSERT(kept < kCapacity);
            terms_[index(kept++)] = x;
        }
        size_ = kept;
    }
    void add_product(double a, double b) {
        const double product = a * b;
        add(std::fma(a, b, -product));
        add(product);
    }
    void add_product(const ExactDifference& a, double b) {
        if (a.low != 0.0) add_product(a.low, b);
        add_product(a.high, b);
    }
    void add_product(const ExactDifference& a, const ExactDifference& b) {
        if (b.low != 0.0) add_product(a, b.low);
        add_product(a, b.high);
    }
    void add_product(const ExactSum& a, const ExactDifference& b) {
        for (int i = 0; i < a.size_; ++i) add_product(b, a.terms_[index(i)]);
    }

    /// -1, 0 or 1: terms do not overlap, so the largest decides.
    int sign() const { return size_ == 0 ? 0 : terms_[index(size_ - 1)] > 0.0 ? 1 : -1; }
    /// The sum, to a relative error of at most 2^-51; exactly 0 for 0.
    double value() const {
        double sum = 0.0;
        for (int i = 0; i < size_; ++i) sum += terms_[index(i)];
        return sum;
    }

private:
    /// Three products of a triangle's corner areas (16 terms each) with a difference (2 terms), 2 for each
    /// product.
    static constexpr int kCapacity = 3 * 16 * 2 * 2;
    static size_t index(int i) { return static_cast<size_t>(i); }

    std::array<double, kCapacity> terms_;
    int size_ = 0;
};

/// -1, 0 or 1: the sign of ab + cd without error.
inline int sign_of_products(const ExactDifference& a, const ExactDifference& b, const ExactDifference& c,
                            const ExactDifference& d) {
    if (a.low == 0.0 && b.low == 0.0 && c.low == 0.0 && d.low == 0.0) {
        // ab + cd = p + q + e + f: the products and what they lost in rounding.
        const double p = a.high * b.high, q = c.high * d.high;
        const double e = std::fma(a.high, b.high, -p), f = std::fma(c.high, d.high, -q);
        const double sum = p + q;  // off by 2^-53 |sum| at most, and without error where it is 0
        if (sum == 0.0) return e + f > 0.0 ? 1 : e + f < 0.0 ? -1 : 0;
        if (std::abs(sum) > 2.0 * (std::abs(e) + std::abs(f))) return sum > 0.0 ? 1 : -1;
    }
    ExactSum sum;
    sum.add_product(a, b);
    sum.add_product(c, d);
    return sum.sign();
}

}  // namespace boxwood
