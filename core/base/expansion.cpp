#include "core/base/expansion.h"

#include <cmath>

namespace boxwood {

namespace {

struct Pair {
    double sum;    // rounded result
    double error;  // exact - rounded
};

/// Shewchuk, theorem 7 (Knuth).
Pair two_sum(double a, double b) {
    const double sum = a + b;
    const double b_virtual = sum - a;
    const double a_virtual = sum - b_virtual;
    return {sum, (a - a_virtual) + (b - b_virtual)};
}

/// Shewchuk, theorem 6 (Dekker): |a| >= |b| or a == 0.
Pair fast_two_sum(double a, double b) {
    const double sum = a + b;
    return {sum, b - (sum - a)};
}

/// Shewchuk, theorem 17 (Veltkamp, Dekker): halves of 26 bits each.
Pair split(double a) {
    const double c = 134217729.0 * a;  // 2^27 + 1
    const double high = c - (c - a);
    return {high, a - high};
}

/// Shewchuk, theorem 18 (Dekker, Veltkamp).
Pair two_product(double a, double b) {
    const double product = a * b;
    const Pair as = split(a), bs = split(b);
    const double e1 = product - as.sum * bs.sum;
    const double e2 = e1 - as.error * bs.sum;
    const double e3 = e2 - as.sum * bs.error;
    return {product, as.error * bs.error - e3};
}

}  // namespace

Expansion Expansion::difference(double a, double b) {
    Expansion result;
    const Pair pair = two_sum(a, -b);
    if (pair.error != 0.0) result.parts_.push_back(pair.error);
    if (pair.sum != 0.0) result.parts_.push_back(pair.sum);
    return result;
}

Expansion Expansion::operator-() const {
    Expansion result = *this;
    for (double& part : result.parts_) part = -part;
    return result;
}

Expansion Expansion::operator+(const Expansion& other) const {
    // Fast expansion sum with zero elimination, section 2.4.
    Expansion result;
    const std::vector<double>& e = parts_;
    const std::vector<double>& f = other.parts_;
    if (e.empty()) return other;
    if (f.empty()) return *this;
    result.parts_.reserve(e.size() + f.size());
    size_t i = 0, j = 0;
    const auto next = [&] {
        if (j == f.size() || (i < e.size() && std::abs(e[i]) < std::abs(f[j]))) return e[i++];
        return f[j++];
    };
    double sum = next();
    for (size_t k = 1; k < e.size() + f.size(); ++k) {
        const Pair pair = two_sum(sum, next());
        if (pair.error != 0.0) result.parts_.push_back(pair.error);
        sum = pair.sum;
    }
    if (sum != 0.0) result.parts_.push_back(sum);
    return result;
}

Expansion Expansion::operator*(double factor) const {
    // Scale expansion with zero elimination, section 2.5.
    Expansion result;
    if (parts_.empty() || factor == 0.0) return result;
    result.parts_.reserve(2 * parts_.size());
    const auto keep = [&](double part) {
        if (part != 0.0) result.parts_.push_back(part);
    };
    Pair product = two_product(parts_[0], factor);
    keep(product.error);
    double carry = product.sum;
    for (size_t i = 1; i < parts_.size(); ++i) {
        product = two_product(parts_[i], factor);
        const Pair low = two_sum(carry, product.error);
        keep(low.error);
        const Pair high = fast_two_sum(product.sum, low.sum);
        keep(high.error);
        carry = high.sum;
    }
    keep(carry);
    return result;
}

Expansion Expansion::operator*(const Expansion& other) const {
    Expansion result;
    for (const double part : other.parts_) result = result + *this * part;
    return result;
}

double Expansion::estimate() const {
    double sum = 0.0, rest = 0.0;
    for (const double part : parts_) {
        const Pair pair = two_sum(sum, part);
        sum = pair.sum;
        rest += pair.error;
    }
    return sum + rest;
}

}  // namespace boxwood
