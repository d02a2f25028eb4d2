#pragma once

#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/store/stage_store.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// View factors of each facet: the ground's sky by the march over the raster, others by
/// rays.
///
/// - sunlight: transmittance of panes for sunlight; else thermal
/// - store: cache of earlier results; null: none
FacetViews scene_sky_view(const Prepared& prepared, bool sunlight = false,
                          const StageStore* store = nullptr);

}  // namespace diurna
