#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "scenes/job/run/check_points.hpp"

namespace diurna {

/// What the temperature of check points counts for in pictures.
struct CheckWeights {
    std::vector<std::size_t> instant;  // of the field, ascending: nearest to pictures, at most 24
    /// (instant of these, observer) its pictures nearest to that instant.
    std::vector<float> pictures;
    std::size_t observers = 0;
    /// (point) [K/K] of apparent temperature for one of the surface: emissivity times the air's
    /// transmittance, rms over the observer's bands beyond 3 µm, at its middle picture.
    std::vector<float> apparent;

    /// Weight of a point at an instant of these: pixels of all pictures for each point.
    double pixels(std::size_t a, const CheckPoint& point) const {
        return double{pictures[a * observers + point.observer]} * double{point.pixels};
    }
};

/// - instants: of the field, ascending, at least one
CheckWeights check_weights(const Prepared& prepared, const CheckPoints& points,
                           std::span<const Instant> instants);

}  // namespace diurna
