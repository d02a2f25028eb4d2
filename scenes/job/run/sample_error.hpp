#pragma once

#include <span>

#include "render/picture/frame.hpp"
#include "render/view/linear_facets.hpp"
#include "scenes/job/run/series.hpp"

namespace diurna {

/// [K] Expected difference of a picture from one with unlimited samples in its pixels, root mean
/// square over them, of apparent temperature in its last band beyond 3 um: from the differences
/// within pixels, with the temperatures that they see of facets, and from the shares of the sun
/// where shadows pass. 0 where pixels have one sample each, or no band is thermal. On dunes and in
/// a city block 1.3 and 1.5 times the error that two seeds show, over all pictures
/// (docs/reference/run-folder.md).
///
/// - frame: the picture
/// - temperature: (facet) [K] at its instant
/// - ground, sun: temperatures within facets and in edges of shadows, at that instant
double sample_error(const Prepared& prepared, const Series& series, const FacetViews& views,
                    const Frame& frame, std::span<const float> temperature,
                    const LinearFacets& ground, const PixelSun& sun);

}  // namespace diurna
