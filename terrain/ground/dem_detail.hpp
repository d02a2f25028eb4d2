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

/// Puts a finer raster on a coarse one (`Dem::detail`), on top of earlier ones. Within the strip
/// its heights become w fine + (1 − w) coarse, w = 3 t² − 2 t³ of t = distance from its border /
/// `blend`: at the border's posts they equal the coarse raster's, so there is no crease. A part
/// outside the coarse raster is ignored, and there is no blending along that edge.
///
/// Posts of the coarse raster whose cells are entirely on the detail take its heights, so that the
/// coarse lattice samples the surface of both.
///
/// Notes the median of fine − coarse over the strip if it is a metre or more: the two may
/// have different vertical datums. Throws InputError for a raster with voids, one that is
/// entirely outside, has a coarser posting than the coarse one, or is too narrow for the
/// strip.
void lay_detail(Dem& dem, Dem fine, const DetailOptions& options);

}  // namespace diurna
