#pragma once

#include <cstdint>

namespace diurna {

/// Random numbers of an instrument: hashes of seed, purpose, place and frame only, so that a frame
/// has the same noise rendered alone or in a series, on any thread.
enum class Draw : std::uint64_t {
    pixel = 1,
    shot,
    row,
    column,
    frame,
    flicker,
    gain,
    offset,
    row_offset,
    column_offset,
    gain_drift,
    offset_drift,
    curve,
    fate,
    blink,
    phase
};

/// Uniform in (0, 1).
double uniform(std::uint64_t seed, Draw purpose, std::uint64_t place, std::uint64_t frame = 0);

/// Mean 0 and variance 1 (Box & Muller 1958).
double normal(std::uint64_t seed, Draw purpose, std::uint64_t place, std::uint64_t frame = 0);

/// Random count of a given mean: Poisson up to 50, normal with that mean and variance above.
double counted(double mean, std::uint64_t seed, std::uint64_t place, std::uint64_t frame);

/// 1/f noise of variance 1: sums of numbers that are constant for 1, 2, 4, ... 2^11 frames (Voss,
/// after Gardner 1978); its power decreases with frequency down to 1/4096 of the frame rate.
double flicker(std::uint64_t seed, std::uint64_t place, std::uint64_t frame);

}  // namespace diurna
