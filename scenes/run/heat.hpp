#pragma once

#include <string>

#include "scenes/plan/prepared.hpp"
#include "scenes/plan/progress.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/solve/solver.hpp"

namespace diurna {

/// What each facet sees: the ground's sky by the march over the raster, all else by rays.
FacetViews scene_sky_view(const Prepared& prepared);

/// Who is in the sun at each step of the heat balance, and when within them shadows' edges pass.
SunExposure scene_sun_exposure(const Prepared& prepared, Progress& progress);

/// In one line by how much a solver has missed its tolerance; "" where it has converged.
std::string not_converged(const Scene& scene, const SolveReport& report);

/// Shadows and heat balance: temperatures alone.
SolveResult solve_scene(const Prepared& prepared, const FacetViews& views, Progress& progress);

}  // namespace diurna
