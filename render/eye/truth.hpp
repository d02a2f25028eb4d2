#pragma once

#include "render/light/radiance_input.hpp"
#include "render/picture/frame.hpp"
#include "render/view/linear_facets.hpp"
#include "render/view/pixel_sun.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Adds the values at the pixels' centres: temperature, range, facet, object, material, normal. On
/// a textured facet the temperature is the fourth root of the weighted mean of T⁴ of its two
/// levels, and the material that of the larger share.
///
/// - sun, ground: temperature differences of pixels from their facets' mean; null: none
void add_truth(const View& view, const RadianceInput& input, const PixelSun* sun,
               const LinearFacets* ground, Frame& frame);

}  // namespace diurna
