#pragma once

#include <functional>

#include "thermal/point/point_facet.hpp"

namespace diurna {

/// What a spin-up has to come back to, after its span, within.
inline constexpr double periodic_tolerance = 1e-6;  // [K]
inline constexpr double standing_tolerance = 1e-3;  // [mm]

/// How a spin-up went.
struct SpunUp {
    int passes = 0;                  // over the span
    double residual = 0.0;           // [K] |P(T) − T| of the last one, worst node
    double standing_residual = 0.0;  // [mm] of water and frost, likewise
    bool converged = false;          // both within their tolerances
};

/// Brings a facet to the state that the span leads back to itself, by Newton on the periodic map.
/// Where its ground freezes, the same ground without freezing goes first: a front that must cross
/// the column moves a node or two a pass.
///
/// facet_of  a facet over given ground, under the weather that went before
SpunUp spin_up(PointFacet& facet, const ThermalSurface& surface, Instant from, Instant to,
               const std::function<PointFacet(const ThermalSurface&)>& facet_of);

}  // namespace diurna
