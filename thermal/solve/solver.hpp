#pragma once

#include "materials/matter/library.hpp"
#include "terrain/facets.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/column/column.hpp"
#include "thermal/heat_flux_field.hpp"
#include "thermal/solve/packed_field.hpp"
#include "thermal/solve/solve_input.hpp"
#include "thermal/solve/solve_report.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

struct SolveResult {
    TemperatureField temperature;
    SolveReport report;
    HeatState end;         // of the span
    HeatFluxField heat{};  // at SolveOptions::heat_at
    PackedField steps{};   // all temperatures, (instant, facet)
};

/// Values that a solve releases or takes over as soon as it needs them no longer as they are.
struct HandedOver {
    SunExposure* sun = nullptr;  // SolveInput::sun; empty afterwards
    /// With SolveInput::from: temperatures at the same number of instants as a first guess for the
    /// span, such as the previous day's; empty: the start's at all instants.
    PackedField guess{};
    HeatState* from = nullptr;  // SolveInput::from: its columns are released once they are taken
};

/// Temperatures of all facets over the span: layered conduction below, the full surface balance
/// above, solved together at every stage of every step.
///
/// Method::modes (thermal/column/reduced_column.hpp): each material's linear column as a few
/// exponential modes, stepped exactly for fluxes linear in time. Method::layered, the reference:
/// SDIRK2 (γ = 1 − 1/√2, second order, L-stable) on the nodes of thermal/column/column.hpp.
/// Inputs are linear between step instants; materials too thin for the step take substeps. The
/// surface equation is solved by Newton together with the column: layered within a bracket, to
/// 1e-12 K; in modes without one, to 1e-9 K, and by bisection to the last bit if ten steps do not
/// converge. A periodic span is solved by Newton on the period map, starting with steps of an
/// hour: each block of facets has its own monodromy matrix, at two steepnesses of its surface,
/// between which each facet interpolates. Neighbours' longwave is solved together with its effect
/// on temperatures, to first order, after each pass (thermal/solve/longwave_exchange.hpp). Same
/// bytes for any number of threads. Facets that need more than a linear column under a dry or
/// evenly wet surface (freezing ground, snow, canopy, water store, schedules) are solved one by
/// one: thermal/solve/point_facets.hpp; those of targets together:
/// thermal/solve/network_facets.hpp.
///
/// A facet that cannot lose heat has no periodic day: then `converged` is false and the residual
/// shows it, as (with `unsolved`) for a facet whose balance has no solution from 1 to 5000 K.
/// Throws InputError if arrays do not match; std::runtime_error, which names facet, material and
/// instant, if a temperature is not a number.
SolveResult solve(const SolveInput& input, const SolveOptions& options, HandedOver given = {});

}  // namespace diurna
