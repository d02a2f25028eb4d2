#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/plan/progress.hpp"
#include "scenes/job/run/check_error.hpp"
#include "scenes/job/run/stages.hpp"
#include "scenes/job/store/inputs.hpp"
#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// One line on how far a solver missed its tolerance; "" if it converged.
std::string not_converged(const SolveReport& report);

/// Throws InputError if the state from which the scene continues is missing, or of another scene or
/// instant: before anything is written.
void check_start(const Prepared& prepared);

/// Whether places in pictures can be solved separately: no state is read or written.
bool can_check(const Prepared& prepared);

/// Temperatures of a scene, and their error at check points.
struct SolvedScene : SpanResult {
    CheckError check{};
    std::size_t places = 0;     // that were checked
    std::size_t unchecked = 0;  // drawn on panes, nets, sheets, targets, copies
};

/// Shadows and heat balance, stage by stage: only temperatures. Throws InputError as
/// check_start(). Where the plan decides that not every facet is solved, those that are neither
/// visible in pictures nor thermally coupled to visible ones use representatives' temperatures
/// (scenes/job/run/needed_facets.hpp), and a note reports their number and kind. A note reports the
/// error at check points, too (scenes/job/run/check_error.hpp); none if a state is written or read.
///
/// - decision: that of the plan for a run with pictures (Plan::decisions); by default every facet
///   is solved, without check points
/// - similar: solves of one scene with other numbers
struct SimilarSolves {
    bool keep_course = false;          // for those that follow: SpanResult::course
    const SpanCourse* like = nullptr;  // of an earlier one, a first guess
    /// The span starts from this state, of an earlier solve with the same columns; null: as the
    /// scene says.
    const HeatState* start = nullptr;
    std::optional<Instant> until{};  // SpanOptions::until
};
SolvedScene solve_scene(const Stages& stages, Progress& progress, const HeatDecision& decision = {},
                        const SimilarSolves& similar = {});

inline constexpr const char* state_file = "state.nc";
/// Writes temperatures with names, clock and fluxes, and also the state at the end, if the scene
/// requests it.
///
/// - inputs: run_inputs() of the scene, named in the file
void write_heat(const Prepared& prepared, const std::vector<RunInput>& inputs,
                const SpanResult& result, const std::filesystem::path& temperatures);

}  // namespace diurna
