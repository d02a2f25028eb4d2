#pragma once

#include <vector>

#include "scenes/input/scene.hpp"
#include "thermal/solve/solver.hpp"

namespace diurna {

/// How the heat balance of a scene is stepped. Temperatures are kept at every frame and, for the
/// curves of a day and where they cross, at least each half hour. `step_instants()` of it are the
/// instants between steps.
SolveOptions scene_solve_options(const Scene& scene);

/// When a picture is taken: every `frame_every` from the start on, without the end, which is the
/// start of a periodic day.
std::vector<Instant> frame_instants(const TimeInput& time);

}  // namespace diurna
