#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "scenes/job/run/check_points.hpp"
#include "scenes/job/run/recommended.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// Difference between the apparent temperatures in pictures and those of points solved separately:
/// the surfaces' times emissivity and transmittance of the air (check_weights.hpp). Mean squares
/// are over the pixels of all pictures beyond 3 µm.
struct CheckError {
    struct Of {
        std::string name;
        double rms = 0.0;  // [K]
        std::size_t points = 0;
    };
    double rms = 0.0;              // [K] over pixels
    double low = 0.0, high = 0.0;  // [K] 95 % interval of rms by bootstrap over points
    double by_rays = 0.0;          // [K] rms, of facets against themselves with more rays
    ErrorParts parts{};            // of the mean square
    std::vector<Recommended>
        set{};                   // settings that bring the rms below the tolerance; empty: it is
    double percentile_99 = 0.0;  // [K]
    double worst = 0.0;          // [K]
    std::string worst_at;        // description: facet, material, local time
    std::vector<Of> observer;    // those with points
    std::vector<Of> share;       // materials, by their part of the squared error, 0 to 1
};

/// Compares the temperatures in pictures at the points (facets' temperatures with sub-facet
/// sunlight, render/view/pixel_heat.hpp) with the patches' own, at 24 of the pictures' instants at
/// most.
///
/// - field: of all surfaces
/// - patches: (instant of field, patch) [K]
CheckError check_error(const Stages& stages, const CheckPoints& points,
                       const TemperatureField& field, std::span<const float> patches);

inline constexpr const char* check_begins = "surface check:";
/// The result in one line.
///
/// - tolerance: [K] rms allowed for pictures; 0: none
std::string in_words(const CheckError& error, const CheckPoints& points, double tolerance);

}  // namespace diurna
