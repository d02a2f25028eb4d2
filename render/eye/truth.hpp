#pragma once

#include "render/light/radiance_input.hpp"
#include "render/picture/frame.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Adds what is at the pixels' centres: temperature, range, facet, object, material, normal. On a
/// textured facet the temperature is the one whose fourth power is the mean of its two surfaces',
/// by shares, and the material the one of the larger share.
void add_truth(const View& view, const RadianceInput& input, Frame& frame);

}  // namespace diurna
