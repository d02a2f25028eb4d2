#pragma once

#include "scenes/plan/prepared.hpp"
#include "scenes/plan/progress.hpp"
#include "terrain/visibility/facet_views.hpp"
#include "thermal/solve/solver.hpp"

namespace diurna {

/// What each facet sees: the ground's sky by the march over the raster, all else by rays.
FacetViews scene_sky_view(const Prepared& prepared);

/// Who is in the sun at each step of the heat balance, and when within them shadows' edges pass.
SunExposure scene_sun_exposure(const Prepared& prepared, Progress& progress);

/// Shadows and heat balance: temperatures alone.
SolveResult solve_scene(const Prepared& prepared, const FacetViews& views, Progress& progress);

}  // namespace diurna
