#pragma once

#include <filesystem>
#include <string>

#include "scenes/plan/prepared.hpp"
#include "scenes/plan/progress.hpp"
#include "scenes/run/stages.hpp"
#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// One line on how far a solver missed its tolerance; "" if it converged.
std::string not_converged(const SolveReport& report);

/// Throws InputError if the state from which the scene continues is missing, or of another scene or
/// instant: before anything is written.
void check_start(const Prepared& prepared);

/// Shadows and heat balance, stage by stage: only temperatures. Throws InputError as
/// check_start(). With a tolerance, facets that are neither visible in pictures nor
/// thermally coupled to visible ones are not solved: they use representatives'
/// temperatures (scenes/run/needed_facets.hpp), and a note reports their number and
/// kind.
///
/// - tolerance: [K] allowed rms error of pictures; 0: every facet is solved
/// - check_points: points in pictures that are solved in addition; a note reports the facets' error
///   (scenes/run/check_error.hpp). None if objects move or a state is written or read
SpanResult solve_scene(const Stages& stages, Progress& progress, double tolerance = 0.0,
                       int check_points = 0);

inline constexpr const char* state_file = "state.nc";
/// Writes temperatures with names, clock and fluxes, and also the state at the end, if the scene
/// requests it.
void write_heat(const Prepared& prepared, const SpanResult& result,
                const std::filesystem::path& temperatures);

}  // namespace diurna
