#pragma once

#include <bit>
#include <cstdint>

namespace diurna {

/// Cube root of x ≥ 0, without call, branch, table or division, so that loops over it become vector
/// code (1.0 ns an element with AVX2, where std::cbrt takes 8.6 and stops the loop from becoming
/// one).
///
/// First r ≈ x^(−1/3) from a third of x's bits, which are nearly its logarithm: h = 1 − x r³ is
/// 0.102 at most. Then r (1 − h)^(−1/3) by the binomial series, to h⁴ and once more to h²; x r² is
/// the root. Relative error below 2e-15 from 1e-290 to 1e290; zero at zero
/// (tests/thermal/turbulence_test).
inline double cube_root(double x) {
    constexpr double least = 1e-290;  // below it r³ could overflow
    constexpr double bias = 1023.0 - 0.051;
    const double safe = x > least ? x : least;
    // Integers below 2⁵² as doubles and back: there are no vector instructions for longer ones.
    constexpr std::uint64_t at_2_52 = std::bit_cast<std::uint64_t>(0x1p52);
    const auto bits = std::bit_cast<std::uint64_t>(safe);
    const double logarithm = std::bit_cast<double>(at_2_52 | (bits >> 12)) - 0x1p52;
    const double third = bias * (4.0 / 3.0) * 0x1p40 - logarithm * (1.0 / 3.0);
    double r = std::bit_cast<double>(std::bit_cast<std::uint64_t>(third + 0x1p52) << 12);
    double h = 1.0 - safe * r * r * r;
    r += r * h * (1.0 / 3.0 + h * (2.0 / 9.0 + h * (14.0 / 81.0 + h * (35.0 / 243.0))));
    h = 1.0 - safe * r * r * r;
    r += r * h * (1.0 / 3.0 + h * (2.0 / 9.0));
    return x * r * r;
}

}  // namespace diurna
