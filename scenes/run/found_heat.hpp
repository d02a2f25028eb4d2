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

/// A scene's heat as this run has solved it, or as an earlier one of the same matter, places,
/// weather and steps has left it in the store.
struct SceneHeat {
    SpanResult result;   // its report, where it was solved
    bool solved = true;  // by this run
    /// "not converged", "start", each "note", each "row ..." of the report's table: of whichever
    /// run has solved it.
    Messages reported;
};

/// As solve_scene(). Taken from the store are temperatures whose instants are among those kept
/// there; not where state or fluxes are asked for.
///
/// - inputs: of the run, for a scene that nothing was changed of since it was read
SceneHeat scene_heat(const Stages& stages, const std::vector<RunInput>& inputs, Progress& progress,
                     double tolerance);

/// What is given by a name: "start".
std::vector<std::string> reported_as(const std::string& name, const SceneHeat& heat);

}  // namespace diurna
