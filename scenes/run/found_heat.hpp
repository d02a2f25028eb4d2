#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/cache/inputs.hpp"
#include "scenes/cache/messages.hpp"
#include "scenes/plan/progress.hpp"
#include "scenes/run/stages.hpp"
#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// A scene's heat solved in this run, or taken from the cache of an earlier run with the same
/// materials, places, weather and steps.
struct SceneHeat {
    SpanResult result;   // its report, if solved
    bool solved = true;  // by this run
    /// "not converged", "start", each "note", each "row ..." of the report's table: from the run
    /// that solved it.
    Messages reported;
};

/// As solve_scene(). From the cache only if its stored instants include those needed; not if state
/// or fluxes are requested.
///
/// - inputs: of the run, for a scene that is unchanged since it was read
SceneHeat scene_heat(const Stages& stages, const std::vector<RunInput>& inputs, Progress& progress,
                     const HeatDecision& decision);

/// Messages with a name: "start".
std::vector<std::string> reported_as(const std::string& name, const SceneHeat& heat);

}  // namespace diurna
