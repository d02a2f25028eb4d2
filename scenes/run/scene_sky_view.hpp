#pragma once

#include "scenes/cache/stage_store.hpp"
#include "scenes/plan/prepared.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// What each facet sees: the ground's sky by the march over the raster, all else by rays.
///
/// - sunlight: of what goes through panes, sunlight; else heat
/// - store: of what earlier runs have found; null: none
FacetViews scene_sky_view(const Prepared& prepared, bool sunlight = false,
                          const StageStore* store = nullptr);

}  // namespace diurna
