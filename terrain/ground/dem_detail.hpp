#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "terrain/raster/dem.hpp"

namespace diurna {

struct DetailOptions {
    double tolerance = 1.0;  // of a mesh of it [m]
    double blend = 20.0;     // width of the strip within its border [m]
};

/// Lays a finer raster on a coarse one (`Dem::detail`), on top of those that lie there. Within the
/// strip its heights become w fine + (1 − w) coarse, w = 3 t² − 2 t³ of t = distance from its
/// border / `blend`: at the border's posts they are the coarse raster's, and no crease shows. Where
/// it hangs over the coarse raster's edge it counts only within, unblended at that edge.
///
/// Posts of the coarse raster whose cells lie wholly on the detail take its heights, so that the
/// coarse lattice samples the surface of both.
///
/// Notes the median of fine − coarse over the strip where that is a metre or more: the two may
/// count their heights from different zeros. Throws InputError for a raster with voids, one that
/// lies wholly outside, has its posts further apart than the coarse one, or is too narrow for the
/// strip.
void lay_detail(Dem& dem, Dem fine, const DetailOptions& options);

}  // namespace diurna
