#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace boxwood {

namespace expansion {

struct Pair {
    double sum;    // rounded result
    double error;  // exact - rounded
};

/// Shewchuk, theorem 7 (Knuth).
inline Pair two_sum(double a, double b) {
    const double sum = a + b;
    const double b_virtual = sum - a;
    const double a_virtual = sum - b_virtual;
    return {sum, (a - a_virtual) + (b - b_virtual)};
}

/// Shewchuk, theorem 6 (Dekker): |a| >= |b| or a == 0.
inline Pair fast_two_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

/// Shewchuk, theorem 17 (Veltkamp, Dekker): halves of 26 bits each.
inline Pair split(double a) {
    const double c = 134217729.0 * a;  // 2^27 + 1
    const double high = c - (c - a);
    return {high, a - high};
}

/// Shewchuk, theorem 18 (Dekker, Veltkamp).
inline Pair two_product(double a, double b) {
    const double product = a * b;
    const Pair as = split(a), bs = split(b);
    const double e1 = product - as.sum * bs.sum;
    const double e2 = e1 - as.error * bs.sum;
    const double e3 = e2 - as.sum * bs.error;
    return {product, as.error * bs.error - e3};
}

}  // namespace expansion

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
    /// A sequence of doubles that allocates only beyond what ordinary triangles take.
    class Parts {
    public:
        bool empty() const { return size_ == 0; }
        size_t size() const { return size_; }
        double operator[](size_t i) const { return i < kNear ? near_[i] : far_[i - kNear]; }
        double& operator[](size_t i) { return i < kNear ? near_[i] : far_[i - kNear]; }
        double back() const { return (*this)[size_ - 1]; }
        void push_back(double part) {
            if (size_ < kNear) {
                near_[size_] = part;
            } else {
                far_.push_back(part);
            }
            ++size_;
        }

    private:
        static constexpr size_t kNear = 24;
        size_t size_ = 0;
        std::array<double, kNear> near_;  ///< not initialised beyond size_
        std::vector<double> far_;
    };

    Parts parts_;
};

inline Expansion Expansion::difference(double a, double b) {
    Expansion result;
    const expansion::Pair pair = expansion::two_sum(a, -b);
    if (pair.error != 0.0) result.parts_.push_back(pair.error);
    if (pair.sum != 0.0) result.parts_.push_back(pair.sum);
    return result;
}

inline Expansion Expansion::operator-() const {
    Expansion result = *this;
    for (size_t i = 0; i < parts_.size(); ++i) result.parts_[i] = -parts_[i];
    return result;
}

inline Expansion Expansion::operator+(const Expansion& other) const {
    // Fast expansion sum with zero elimination, section 2.4.
    Expansion result;
    const Parts& e = parts_;
    const Parts& f = other.parts_;
    if (e.empty()) return other;
    if (f.empty()) return *this;
    size_t i = 0, j = 0;
    const auto next = [&] {
        if (j == f.size() || (i < e.size() && std::abs(e[i]) < std::abs(f[j]))) return e[i++];
        return f[j++];
    };
    double sum = next();
    for (size_t k = 1; k < e.size() + f.size(); ++k) {
        const expansion::Pair pair = expansion::two_sum(sum, next());
        if (pair.error != 0.0) result.parts_.push_back(pair.error);
        sum = pair.sum;
    }
    if (sum != 0.0) result.parts_.push_back(sum);
    return result;
}

inline Expansion Expansion::operator*(double factor) const {
    // Scale expansion with zero elimination, section 2.5.
    Expansion result;
    if (parts_.empty() || factor == 0.0) return result;
    const auto keep = [&](double part) {
        if (part != 0.0) result.parts_.push_back(part);
    };
    expansion::Pair product = expansion::two_product(parts_[0], factor);
    keep(product.error);
    double carry = product.sum;
    for (size_t i = 1; i < parts_.size(); ++i) {
        product = expansion::two_product(parts_[i], factor);
        const expansion::Pair low = expansion::two_sum(carry, product.error);
        keep(low.error);
        const expansion::Pair high = expansion::fast_two_sum(product.sum, low.sum);
        keep(high.error);
        carry = high.sum;
    }
    keep(carry);
    return result;
}

inline Expansion Expansion::operator*(const Expansion& other) const {
    Expansion result;
    for (size_t i = 0; i < other.parts_.size(); ++i) result = result + *this * other.parts_[i];
    return result;
}

inline double Expansion::estimate() const {
    double sum = 0.0, rest = 0.0;
    for (size_t i = 0; i < parts_.size(); ++i) {
        const expansion::Pair pair = expansion::two_sum(sum, parts_[i]);
        sum = pair.sum;
        rest += pair.error;
    }
    return sum + rest;
}

}  // namespace boxwood
