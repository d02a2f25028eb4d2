#pragma once

#include <cstdint>
#include <vector>

#include "render/instrument/instrument.hpp"

namespace diurna {

enum class Fate : std::uint8_t { whole, dark, full, blinking };

/// How each pixel differs from the others, row by row from the upper left; in the signal's unit.
struct Pattern {
    int width = 0, height = 0;
    std::vector<float> gain;          // 1 on the average
    std::vector<float> offset;        // of pixel, row and column
    std::vector<float> gain_drift;    // an hour
    std::vector<float> offset_drift;  // an hour
    std::vector<float> curve;         // share lacking at a full well
    std::vector<Fate> fate;

    /// What a pixel makes of a signal, `hours` after the last correction.
    double answer(std::size_t p, double signal, double well, double hours) const {
        const double bent = signal * (1.0 - double{curve[p]} * signal / well);
        return (double{gain[p]} + hours * double{gain_drift[p]}) * bent + double{offset[p]} +
               hours * double{offset_drift[p]};
    }
};

/// - unit: noise_unit() of the detector
Pattern pattern_of(const Detector& detector, std::uint64_t seed, int width, int height,
                   double unit);

/// The straight line through the answers to two signals, turned back: corrected = scale · answer +
/// shift.
struct PixelCorrection {
    double scale = 1.0, shift = 0.0;
};
/// - seen: what the pixel got of the one or two even lights; shown: what it is to show of them
PixelCorrection two_point(const Pattern& pattern, std::size_t p, double well,
                          const double (&seen)[2], const double (&shown)[2]);
PixelCorrection one_point(const Pattern& pattern, std::size_t p, double well, double seen,
                          double shown);

/// Puts the mean of the whole ones among the eight neighbours in place of dead pixels; returns how
/// many stay for want of one.
std::size_t replace_dead(const Pattern& pattern, std::vector<float>& signal);

}  // namespace diurna
