#pragma once

#include <string>
#include <vector>

#include "scenes/job/plan/progress.hpp"
#include "scenes/job/run/heat_report.hpp"
#include "scenes/job/run/stages.hpp"
#include "scenes/job/store/inputs.hpp"
#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// A scene's heat solved in this run, or taken from the cache of an earlier run with the same
/// materials, places, weather and steps.
struct SceneHeat {
    SpanResult result;   // its own report, if solved
    bool solved = true;  // by this run
    HeatReport report;   // of the run that solved it
};

/// As solve_scene(). From the cache only if its stored instants include those needed; not if state
/// or fluxes are requested, or the scene has radiometers.
///
/// - inputs: of the run, for a scene that is unchanged since it was read
SceneHeat scene_heat(const Stages& stages, const std::vector<RunInput>& inputs, Progress& progress,
                     const HeatDecision& decision);

}  // namespace diurna
