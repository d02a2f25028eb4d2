#pragma once

#include <cstddef>
#include <string>

#include "materials/matter/library.hpp"
#include "terrain/facets.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/column/column.hpp"
#include "thermal/heat_flux_field.hpp"
#include "thermal/solve/solve_input.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// How the solve went, for the report. Nothing here is an estimate unless it says so.
struct SolveReport {
    bool converged = false;
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
    /// Facets with a store that was left out: no rain fell on them, and dew was worth less than
    /// `dew_left_out` [K]; or it condenses there as the ground's own water would. The most dew
    /// [kg m⁻²] that any of them had.
    std::size_t unfollowed = 0;
    double most_dew_unfollowed = 0.0, dew_left_out = 0.0;
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

struct SolveResult {
    TemperatureField temperature;
    SolveReport report;
    HeatState end;         // of the span
    HeatFluxField heat{};  // at SolveOptions::heat_at
};

/// Temperatures of all facets over the span: layered conduction below, the full surface balance
/// above, solved together at every stage of every step.
///
/// Method::modes (thermal/column/reduced_column.hpp): each material's linear column as a few
/// exponential modes, stepped exactly for fluxes linear in time. Method::layered, the reference:
/// SDIRK2 (γ = 1 − 1/√2, second order, L-stable) on the nodes of thermal/column/column.hpp. Forcing
/// is linear between step instants; materials too thin for the step are stepped more often. The
/// surface equation is solved by Newton together with the column: layered within a bracket, to
/// 1e-12 K; in modes without one, to 1e-9 K, and by halving a bracket to its last bit where ten
/// steps did not do. A periodic span is found by Newton on the period map, begun on steps of an
/// hour: each block of facets has its own monodromy matrix, at two steepnesses of its surface,
/// between which each facet finds its own. What neighbours send in longwave is solved for together
/// with what it does to temperatures, to first order, after each pass
/// (thermal/solve/longwave_exchange.hpp). Same bytes for any number of threads. Facets whose
/// material asks for more than a linear column under a dry or evenly wet surface (freezing ground,
/// snow, canopy, store of water, schedules) are solved one by one: thermal/solve/point_facets.hpp;
/// those of targets together: thermal/solve/network_facets.hpp.
///
/// A facet that can lose no heat has no periodic day: `converged` is false then and the residual
/// tells, as it does, with `unsolved`, of a facet whose balance has no solution from 1 to 5000 K.
/// Throws InputError if arrays do not match; std::runtime_error, which names facet, material and
/// instant, if a temperature comes out that is no number.
SolveResult solve(const SolveInput& input, const SolveOptions& options);

}  // namespace diurna
