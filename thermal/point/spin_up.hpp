#pragma once

#include <functional>

#include "thermal/point/point_facet.hpp"

namespace diurna {

/// A spin-up ends when no node differs by more between the start and the end of its span.
inline constexpr double periodic_tolerance = 1e-6;  // [K]

/// Result of a spin-up.
struct SpunUp {
    int passes = 0;                  // over the span
    double residual = 0.0;           // [K] |P(T) − T| of the last one, worst node
    double error = 0.0;              // [K] the larger of this and Newton's last move, worst node
    double standing_residual = 0.0;  // [mm] of water and frost: change over the last pass
    bool store_held = false;         // these change from day to day; their start is fixed
    bool converged = false;
};

/// Finds the state of a facet that repeats after the span, by Newton on the periodic map. If its
/// ground freezes, the same ground without freezing is solved first: a front that must cross the
/// column moves only a node or two per pass.
///
/// Where dew begins or ends at another step from pass to pass, the residual may stay above 1e-6 K:
/// the state has converged if Newton's last move is below the error allowed to a step.
///
/// tolerance  [K] of a step (PointJob::tolerance)
/// facet_of   creates a facet over given ground, under the preceding weather
SpunUp spin_up(PointFacet& facet, const ThermalSurface& surface, Instant from, Instant to,
               double tolerance, const std::function<PointFacet(const ThermalSurface&)>& facet_of);

}  // namespace diurna
