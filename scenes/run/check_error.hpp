#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scenes/run/check_points.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// How far the temperatures that pictures show are from those of the places themselves.
struct CheckError {
    struct Of {
        std::string name;
        double rms = 0.0;  // [K]
        std::size_t points = 0;
    };
    double rms = 0.0;              // [K] over points and instants
    double low = 0.0, high = 0.0;  // [K] 95 % interval of rms, by drawing points again (bootstrap)
    double by_rays = 0.0;          // [K] rms likewise, of facets from themselves with more rays
    double percentile_99 = 0.0;    // [K]
    double worst = 0.0;            // [K]
    std::string worst_at;          // in words: facet, material, local time
    std::vector<Of> observer;      // those that have points
    std::vector<Of> share;  // materials, by their part of the square: rms is that part, 0 to 1
};

/// Compares what pictures show at the points, facets' temperatures with what the sun makes of them
/// within a facet (render/view/pixel_heat.hpp), with the patches' own, at 24 instants at most.
///
/// - field: of all surfaces
/// - patches: (instant of field, patch) [K]
CheckError check_error(const Prepared& prepared, const CheckPoints& points,
                       const TemperatureField& field, std::span<const float> patches);

inline constexpr const char* check_begins = "surface check:";
/// In one line, which begins so.
///
/// - tolerance: [K] rms that pictures were allowed; 0: none was named
std::string in_words(const CheckError& error, const CheckPoints& points, double tolerance);

}  // namespace diurna
