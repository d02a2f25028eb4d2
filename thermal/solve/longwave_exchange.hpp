#pragma once

#include "thermal/solve/moved_longwave.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Whether any facet sees another one, or ground beyond the scene's edge.
bool exchanging(const SolveInput& input);

/// Result of updating the neighbours' longwave.
struct ExchangeChange {
    double heat = 0.0;    // [W m⁻²] largest change of irradiance, at unchanged temperatures
    double warmer = 0.0;  // [K] largest change of temperatures due to it
};

/// Updates the longwave that facets exchange (thermal/solve/facet_exchange.hpp) from their
/// temperatures, with all reflections, to 0.002 W/m² or a thousandth of the change
/// (terrain/visibility/interreflection.hpp), and temperatures and longwave from each other
/// until they agree to first order: additional irradiance warms a facet by its block's
/// linearised span (thermal/solve/linearised_span.hpp), periodic if the span is, and a
/// warmer facet emits more. Starts and temperatures are corrected too, so that the next pass
/// has little to change. Blocks that have not run on this level yet only receive the
/// longwave.
ExchangeChange exchange_longwave(SolveState& solve, const Level& level, ExchangeRoom& room);

}  // namespace diurna
