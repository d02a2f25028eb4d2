#pragma once

#include <functional>

#include "thermal/point/point_facet.hpp"

namespace diurna {

/// Tolerances of a spin-up: largest difference between the start and the end of its span.
inline constexpr double periodic_tolerance = 1e-6;  // [K]
inline constexpr double standing_tolerance = 1e-3;  // [mm]

/// Result of a spin-up.
struct SpunUp {
    int passes = 0;                  // over the span
    double residual = 0.0;           // [K] |P(T) − T| of the last one, worst node
    double standing_residual = 0.0;  // [mm] of water and frost, the same
    bool converged = false;          // both within their tolerances
};

/// Finds the state of a facet that repeats after the span, by Newton on the periodic map. If its
/// ground freezes, the same ground without freezing is solved first: a front that must cross the
/// column moves only a node or two per pass.
///
/// facet_of  creates a facet over given ground, under the preceding weather
SpunUp spin_up(PointFacet& facet, const ThermalSurface& surface, Instant from, Instant to,
               const std::function<PointFacet(const ThermalSurface&)>& facet_of);

}  // namespace diurna
