#pragma once

#include <bit>
#include <cstdint>

namespace diurna {

/// x = k ln 2 + rest, |rest| ≤ ln 2 / 2, and scale = 2ᵏ by its bits; x between −708 and 709.
struct ExpParts {
    double rest, scale;
};
inline ExpParts exp_parts(double x) {
    constexpr double log2_e = 1.4426950408889634074;
    constexpr double ln2_high = 6.93147180369123816490e-01;  // fdlibm: 32 bits, so k·high is exact
    constexpr double ln2_low = 1.90821492927058770002e-10;
    constexpr double shifter = 0x1.8p52;  // adding it rounds to an integer in the low bits
    const double shifted = x * log2_e + shifter;
    const double k = shifted - shifter;
    const auto bits = (std::bit_cast<std::uint64_t>(shifted) + 1023u) << 52;
    return {(x - k * ln2_high) - k * ln2_low, std::bit_cast<double>(bits)};
}
/// eʳ by Taylor's series to r¹², whose remainder is 1.7e-16 for |r| ≤ ln 2 / 2.
inline double exp_series(double r) {
    double p = 1.0 / 479001600.0;
    p = p * r + 1.0 / 39916800.0;
    p = p * r + 1.0 / 3628800.0;
    p = p * r + 1.0 / 362880.0;
    p = p * r + 1.0 / 40320.0;
    p = p * r + 1.0 / 5040.0;
    p = p * r + 1.0 / 720.0;
    p = p * r + 1.0 / 120.0;
    p = p * r + 1.0 / 24.0;
    p = p * r + 1.0 / 6.0;
    p = p * r + 0.5;
    p = p * r + 1.0;
    return p * r + 1.0;
}

/// exp(x), x clamped to −708 to 709.
///
/// Written without branches or tables so that loops over it become vector code where comparisons
/// may (-fno-trapping-math): 1.2 ns an element with AVX2, against 3.7 ns for std::exp. Relative
/// error below 5e-16 (tests/materials/planck_test.cpp). NaN stays NaN.
inline double fast_exp(double x) {
    x = x < -708.0 ? -708.0 : x;
    x = x > 709.0 ? 709.0 : x;
    const ExpParts parts = exp_parts(x);
    return exp_series(parts.rest) * parts.scale;
}

/// The same in single precision, x clamped to −87 to 88: series to r⁶, relative error below 3e-7.
/// 0.3 ns an element with AVX2.
inline float fast_exp(float x) {
    constexpr float log2_e = 1.44269504f, ln2_high = 0.693359375f, ln2_low = -2.12194440e-4f;
    constexpr float shifter = 0x1.8p23f;
    x = x < -87.0f ? -87.0f : x;
    x = x > 88.0f ? 88.0f : x;
    const float shifted = x * log2_e + shifter;
    const float k = shifted - shifter;
    const float r = (x - k * ln2_high) - k * ln2_low;
    float p = 1.0f / 720.0f;
    p = p * r + 1.0f / 120.0f;
    p = p * r + 1.0f / 24.0f;
    p = p * r + 1.0f / 6.0f;
    p = p * r + 0.5f;
    p = p * r + 1.0f;
    p = p * r + 1.0f;
    const auto bits = (std::bit_cast<std::uint32_t>(shifted) + 127u) << 23;
    return p * std::bit_cast<float>(bits);
}

}  // namespace diurna
