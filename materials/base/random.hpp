#pragma once

#include <cmath>
#include <cstdint>
#include <utility>

/// Pseudo-random numbers that are functions of their arguments only (seed, facet, pixel, sample),
/// so that the same input gives the same bytes on any number of threads; and sequences that fill a
/// range evenly.
namespace diurna {

/// Odd increments that keep successive counters far apart: 2⁶⁴ and 2³² over the golden ratio, and
/// 2⁶⁴ times the first step of Roberts' R3 sequence for a second counter.
inline constexpr std::uint64_t golden_step = 0x9E3779B97F4A7C15u;
inline constexpr std::uint32_t golden_step32 = 0x9E3779B9u;
inline constexpr std::uint64_t second_step = 0xD1B54A32D192ED03u;

/// Each of the 64 input bits changes all output bits: SplitMix64's finaliser (Stafford's variant 13
/// of MurmurHash3's). Zero stays zero.
constexpr std::uint64_t spread_bits(std::uint64_t x) {
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
    return x ^ (x >> 31);
}
/// The same for 32 bits (Wellons' lowbias32): cheap in vector code.
constexpr std::uint32_t spread_bits(std::uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7FEB352Du;
    x = (x ^ (x >> 15)) * 0x846CA68Bu;
    return x ^ (x >> 16);
}

/// SplitMix64 (Steele, Lea & Flood 2014) at a state: the hash of a number, zero included.
constexpr std::uint64_t hashed(std::uint64_t x) { return spread_bits(x + golden_step); }

/// Uniform in [0, 1) from the upper 53 of 64 bits.
constexpr double unit_interval(std::uint64_t bits) {
    return static_cast<double>(bits >> 11) * 0x1p-53;
}

/// A stream of numbers uniform in [0, 1), determined by its start (SplitMix64).
struct RandomStream {
    std::uint64_t state;
    double operator()() {
        const double drawn = unit_interval(hashed(state));
        state += golden_step;
        return drawn;
    }
};

/// Steps of Roberts' R2 sequence: any number of its first points fills the unit square evenly;
/// point k is (start + k step) modulo 1. Also in units of 2⁻³².
inline constexpr double even_step_x = 0.7548776662466927, even_step_y = 0.5698402909980532;
inline constexpr std::uint32_t even_step32_x = 3242174889u, even_step32_y = 2447445414u;

/// Splits n > 0 into columns × rows, as nearly square as possible, n = columns · rows: cells for
/// stratified samples.
inline std::pair<int, int> nearly_square(int n) {
    int rows = static_cast<int>(std::sqrt(static_cast<double>(n)));
    while (n % rows != 0) --rows;
    return {n / rows, rows};
}

}  // namespace diurna
