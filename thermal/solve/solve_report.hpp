#pragma once

#include <cstddef>
#include <string>

namespace diurna {

/// How the solve went, for the report. Nothing here is an estimate unless stated.
struct SolveReport {
    bool converged = false;     // `estimated_error` is within SolveOptions::settled
    bool within_error = false;  // the same, after the last pass
    std::size_t facets = 0;
    int steps = 0;                   // per pass
    int passes = 0;                  // over the span
    double periodic_residual = 0.0;  // [K] worst |P(T) − T| over facets and nodes, last pass
    double estimated_error = 0.0;    // [K] residual through (I − M)⁻¹, and neighbours' effect
    double limit = 0.0;              // [K] of it: SolveOptions::settled
    double left_by_pass = 1.0;       // share of the error that a pass leaves, measured in hours
    double exchange_change = 0.0;    // [W m⁻²] worst change of terrain longwave, last pass
    double light_change = 0.0;       // [W m⁻²] largest change of absorbed reflected light due to
                                     // changes of snow and wetness in the last pass
    double worst_energy_closure = 0.0;  // |stored − in| / Σ|terms|, worst facet and step
    double newton_iterations = 0.0;     // mean per stage
    int worst_newton_iterations = 0;
    std::size_t bisections = 0;  // lanes × iterations outside the bracket
    std::size_t points = 0;      // facets solved as points (thermal/solve/point_facets.hpp)
    std::size_t batched = 0;     // of these, in lanes
    std::size_t stores = 0;      // of these, with rain, dew and snow
    /// Facets whose store was skipped: no rain, and dew with an effect below `dew_left_out` [K]; or
    /// it condenses there as the ground's own water would. The largest amount of dew [kg m⁻²] of
    /// any of them.
    std::size_t unfollowed = 0;
    double most_dew_unfollowed = 0.0, dew_left_out = 0.0;
    /// Facets on which hoar or snow grows or melts from day to day, without a periodic day: the
    /// span starts after eight such days. The largest change per day [mm].
    std::size_t stores_held = 0;
    double store_growth = 0.0;
    /// Facets without a periodic day, whose days alternate (two balances of a calm night): an
    /// intermediate one is used; the difference between its end and its start [K], and the worst
    /// facet.
    std::size_t alternating = 0;
    double alternation = 0.0;
    std::string alternating_facet{};
    std::string furthest{};            // the facets with the largest residual, as text
    double worst_water_closure = 0.0;  // [kg m⁻²] fallen + condensed − evaporated − run off − kept
    double target_residual = 0.0;   // [K] |P(T) − T| of targets' nodes and lumps
    std::size_t target_facets = 0;  // of targets (thermal/solve/network_facets.hpp)
    int point_passes = 0;           // over the span, the largest number
    int limited = 0;                // their steps by the fallback method
    /// Parts without a solution, as text: a facet, its material, an instant; "" if none.
    std::string unsolved{};
    double coldest = 0.0, warmest = 0;  // [K] surface
    double exchange_seconds = 0.0, step_seconds = 0.0, seconds = 0.0;
    double step_cpu_seconds = 0.0;  // of all threads; step_seconds is elapsed time
};

}  // namespace diurna
