#pragma once

#include <cstdint>
#include <vector>

#include "render/instrument/instrument.hpp"

namespace diurna {

enum class Fate : std::uint8_t { whole, dark, full, blinking };

/// Fixed differences between pixels, row by row from the upper left; in the signal's unit.
struct Pattern {
    int width = 0, height = 0;
    std::vector<float> gain;          // mean 1
    std::vector<float> offset;        // of pixel, row and column
    std::vector<float> gain_drift;    // per hour
    std::vector<float> offset_drift;  // per hour
    std::vector<float> curve;         // relative loss at a full well
    std::vector<Fate> fate;

    /// Output of a pixel for a signal, `hours` after the last correction.
    double answer(std::size_t p, double signal, double well, double hours) const {
        const double bent = signal * (1.0 - double{curve[p]} * signal / well);
        return (double{gain[p]} + hours * double{gain_drift[p]}) * bent + double{offset[p]} +
               hours * double{offset_drift[p]};
    }
};

/// - unit: noise_unit() of the detector
Pattern pattern_of(const Detector& detector, std::uint64_t seed, int width, int height,
                   double unit);

/// The inverse of the straight line through the outputs for two signals: corrected = scale · output
/// + shift.
struct PixelCorrection {
    double scale = 1.0, shift = 0.0;
};
/// - seen: the pixel's signals of the one or two uniform lights; shown: their correct values
PixelCorrection two_point(const Pattern& pattern, std::size_t p, double well,
                          const double (&seen)[2], const double (&shown)[2]);
PixelCorrection one_point(const Pattern& pattern, std::size_t p, double well, double seen,
                          double shown);

/// Replaces dead pixels by the mean of the working ones among the eight neighbours; returns the
/// number left without working neighbours.
std::size_t replace_dead(const Pattern& pattern, std::vector<float>& signal);

}  // namespace diurna
