#pragma once

#include <cstddef>
#include <span>

#include "thermal/surface/turbulence.hpp"

namespace diurna {

/// Where one lane's heat jumps within a step.
struct HeatJump {
    std::size_t lane;
    double share;  // of the step, 0 to 1
    double heat;   // [W m⁻²] what it rises by
};

/// The air over facets at one instant: the same over all, or each on the line from one height's air
/// to a higher one's.
struct AirOver {
    const AirFilm& low;
    const AirFilm* high = nullptr;
    const double* up = nullptr;  // (lane) share of the way; null: `low` over all

    AirOver(const AirFilm& one) : low(one) {}
    AirOver(const AirFilm& lower, const AirFilm& higher, const double* lanes_up)
        : low(lower), high(&higher), up(lanes_up) {}
    AirFilm at(std::size_t lane) const { return up ? air_between(low, *high, up[lane]) : low; }
};

/// Air and heat [lane], units filled up, (absorbed sun and longwave, internal) at the instants a
/// step joins.
struct ModeForcing {
    AirOver air_before, air;
    const double *heat_before, *heat;
    std::span<const HeatJump> jumps;  // the step is split there, for those lanes
};

}  // namespace diurna
