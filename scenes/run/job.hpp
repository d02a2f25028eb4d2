#pragma once

#include "scenes/input/scene.hpp"
#include "scenes/plan/job_report.hpp"
#include "scenes/plan/plan.hpp"
#include "scenes/plan/progress.hpp"
#include "scenes/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/solve/solver.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The whole way: plan, build, solve, render, write. Results are the same bytes for any number
/// of threads. A killed run leaves whole files only and can be resumed.
JobReport run_job(Scene scene, const JobOptions& options);

}  // namespace diurna
