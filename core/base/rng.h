#pragma once

#include <cstdint>

namespace boxwood {

/// Bijective 64-bit mix: the finaliser of SplitMix64. Steele, Lea, Flood, "Fast Splittable Pseudorandom
/// Number Generators", OOPSLA 2014, figure 14.
inline uint64_t mix_bits(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

/// SplitMix64: the same numbers on every compiler.
class Rng {
public:
    explicit Rng(uint64_t seed) : state_(seed) {}
    uint64_t next_bits() { return mix_bits(state_ += 0x9e3779b97f4a7c15ull); }
    /// Uniform in [0, 1), a multiple of 2^-24.
    float next() { return static_cast<float>(next_bits() >> 40) * 0x1p-24f; }
    float next(float lower, float upper) { return lower + (upper - lower) * next(); }
    /// Uniform in [0, count), count > 0; the bias of count / 2^64 is accepted.
    uint64_t next_index(uint64_t count) { return next_bits() % count; }

private:
    uint64_t state_;
};

/// Counter-based: uniform in [0, 1) from four keys, such as pixel, sample, bounce, dimension. No state, any
/// order.
inline float hashed_float(uint32_t a, uint32_t b, uint32_t c, uint32_t d) {
    const uint64_t low = mix_bits((uint64_t{a} << 32 | b) + 0x9e3779b97f4a7c15ull);
    return static_cast<float>(mix_bits(low ^ (uint64_t{c} << 32 | d)) >> 40) * 0x1p-24f;
}

}  // namespace boxwood
