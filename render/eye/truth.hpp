#pragma once

#include "render/light/radiance_input.hpp"
#include "render/picture/frame.hpp"
#include "render/view/pixel_sun.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Adds what is at the pixels' centres: temperature, range, facet, object, material, normal. On a
/// textured facet the temperature is the one whose fourth power is the mean of its two surfaces',
/// by shares, and the material the one of the larger share.
///
/// - sun: how much warmer pixels are than their facets' mean; null: not at all
void add_truth(const View& view, const RadianceInput& input, const PixelSun* sun, Frame& frame);

}  // namespace diurna
