#pragma once

#include <cstddef>
#include <string>

namespace diurna {

/// How the solve went, for the report. Nothing here is an estimate unless it says so.
struct SolveReport {
    bool converged = false;     // `estimated_error` is within SolveOptions::settled
    bool within_error = false;  // likewise, after the last pass
    std::size_t facets = 0;
    int steps = 0;                   // per pass
    int passes = 0;                  // over the span
    double periodic_residual = 0.0;  // [K] worst |P(T) − T| over facets and nodes, last pass
    double estimated_error = 0.0;  // [K] that residual through (I − M)⁻¹, and what neighbours do
    double exchange_change = 0.0;  // [W m⁻²] worst change of terrain longwave, last pass
    double light_change = 0.0;  // [W m⁻²] worst change of what facets take in of the light that
                                // others reflect, as snow and wetness changed in the last pass
    double worst_energy_closure = 0.0;  // |stored − in| / Σ|terms|, worst facet and step
    double newton_iterations = 0.0;     // mean per stage
    int worst_newton_iterations = 0;
    std::size_t bisections = 0;  // lanes × iterations that left the bracket
    std::size_t points = 0;      // facets that need more (thermal/solve/point_facets.hpp)
    std::size_t batched = 0;     // of these, in lanes side by side
    std::size_t stores = 0;      // of these, whose rain, dew, snow was followed
    /// Facets with a store that was skipped: no rain fell on them, and dew was worth less than
    /// `dew_left_out` [K]; or it condenses there as the ground's own water would. The most dew
    /// [kg m⁻²] that any of them had.
    std::size_t unfollowed = 0;
    double most_dew_unfollowed = 0.0, dew_left_out = 0.0;
    /// Facets on which hoar or snow grows or melts on from day to day, so that none repeats: the
    /// span starts with what eight such days leave. The most by which it changes in a day [mm].
    std::size_t stores_held = 0;
    double store_growth = 0.0;
    /// Facets without a repeated day, whose days alternate (two balances of a calm night): one is
    /// taken that lies between; by how much its end differs from its start [K], and the worst
    /// facet.
    std::size_t alternating = 0;
    double alternation = 0.0;
    std::string alternating_facet{};
    std::string furthest{};            // the facets with the largest residual, in words
    double worst_water_closure = 0.0;  // [kg m⁻²] fallen + condensed − evaporated − run off − kept
    double target_residual = 0.0;   // [K] likewise |P(T) − T| of targets' nodes and lumps
    std::size_t target_facets = 0;  // of targets (thermal/solve/network_facets.hpp)
    int point_passes = 0;           // over the span, the worst of them
    int limited = 0;                // their steps that had to be taken otherwise than asked
    /// What has no solution, in words: a facet, its material, an instant; "" where all has one.
    std::string unsolved{};
    double coldest = 0.0, warmest = 0;  // [K] surface
    double exchange_seconds = 0.0, step_seconds = 0.0, seconds = 0.0;
    double step_cpu_seconds = 0.0;  // of all threads, where step_seconds is time on the clock
};

}  // namespace diurna
