#pragma once

#include <filesystem>
#include <string>

#include "scenes/plan/prepared.hpp"
#include "scenes/plan/progress.hpp"
#include "scenes/run/stages.hpp"
#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// In one line by how much a solver has missed its tolerance; "" where it has converged.
std::string not_converged(const SolveReport& report);

/// Throws InputError where the state that the scene goes on from is none, or of another scene or
/// instant: before anything is written.
void check_start(const Prepared& prepared);

/// Shadows and heat balance, stage by stage: temperatures alone. Throws InputError as
/// check_start().
/// Where a tolerance is given, facets that no picture sees and whose heat none feels are not
/// solved: others stand for them (scenes/run/needed_facets.hpp), and a note reports how many and
/// what of.
///
/// - tolerance: [K] rms that pictures may be worse by; 0: every facet is solved
/// - check_points: places in pictures that are solved besides; a note reports how far facets are
///   from them (scenes/run/check_error.hpp). None where objects move or a state is kept or read
SpanResult solve_scene(const Stages& stages, Progress& progress, double tolerance = 0.0,
                       int check_points = 0);

inline constexpr const char* state_file = "state.nc";
/// Writes temperatures with names, clock and fluxes, and beside them the state at the end, if the
/// scene asks for it.
void write_heat(const Prepared& prepared, const SpanResult& result,
                const std::filesystem::path& temperatures);

}  // namespace diurna
