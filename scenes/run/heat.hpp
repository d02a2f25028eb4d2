#pragma once

#include <string>

#include "scenes/plan/prepared.hpp"
#include "scenes/plan/progress.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// What each facet sees: the ground's sky by the march over the raster, all else by rays.
///
/// - sunlight: of what goes through panes, sunlight; else heat
FacetViews scene_sky_view(const Prepared& prepared, bool sunlight = false);

/// Who is in the sun at each of some instants, and when between them shadows' edges pass.
SunExposure scene_sun_exposure(const Prepared& prepared, const std::vector<Instant>& instants);

/// In one line by how much a solver has missed its tolerance; "" where it has converged.
std::string not_converged(const SolveReport& report);

/// Shadows and heat balance: temperatures alone.
SpanResult solve_scene(const Prepared& prepared, const FacetViews& views, Progress& progress);

}  // namespace diurna
