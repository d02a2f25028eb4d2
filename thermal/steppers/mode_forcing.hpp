#pragma once

#include <cstddef>
#include <span>

#include "thermal/surface/turbulence.hpp"

namespace diurna {

/// A jump of one lane's heat input within a step.
struct HeatJump {
    std::size_t lane;
    double share;  // of the step, 0 to 1
    double heat;   // [W m⁻²] size of the jump
};

/// The air over facets at one instant: the same over all, or interpolated for each between the air
/// at a lower and at a higher height.
struct AirOver {
    const AirFilm& low;
    const AirFilm* high = nullptr;
    const double* up = nullptr;  // (lane) fraction of the way; null: `low` over all

    AirOver(const AirFilm& one) : low(one) {}
    AirOver(const AirFilm& lower, const AirFilm& higher, const double* lanes_up)
        : low(lower), high(&higher), up(lanes_up) {}
    AirFilm at(std::size_t lane) const { return up ? air_between(low, *high, up[lane]) : low; }
};

/// Air and heat [lane], padded to units, (absorbed sun and longwave, internal) at the start and the
/// end of a step.
struct ModeForcing {
    AirOver air_before, air;
    const double *heat_before, *heat;
    std::span<const HeatJump> jumps;  // for those lanes the step is split there
};

}  // namespace diurna
