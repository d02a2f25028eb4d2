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

/// Air and heat [lane], units filled up, (absorbed sun and longwave, internal) at the instants a
/// step joins.
struct ModeForcing {
    const AirFilm &air_before, &air;
    const double *heat_before, *heat;
    std::span<const HeatJump> jumps;  // the step is split there, for those lanes
};

}  // namespace diurna
