#pragma once

#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// Whether any facet sees another, or ground beyond the scene's edge.
bool exchanging(const SolveInput& input);

/// What renewing the neighbours' longwave did.
struct ExchangeChange {
    double heat = 0.0;    // [W m⁻²] largest change of what arrives, at temperatures as they were
    double warmer = 0.0;  // [K] largest change of temperatures that follows from it
};

/// Renews the longwave that facets send each other (thermal/solve/facet_exchange.hpp) from their
/// temperatures and all it is reflected, within 0.002 W/m² or a thousandth of what changed
/// (terrain/visibility/interreflection.hpp), and both from each other until they agree to first
/// order: what more arrives warms
/// a facet as its block's linearised span has it (thermal/solve/linearised_span.hpp), periodic if
/// the span is, and what is warmer sends more. Starts and temperatures move with it, so that the
/// next pass finds little left. Blocks that have not run on this level yet are only given the
/// longwave.
ExchangeChange exchange_longwave(SolveState& solve, const Level& level);

}  // namespace diurna
