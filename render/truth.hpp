#pragma once

#include "render/frame.hpp"
#include "render/radiance.hpp"
#include "render/view.hpp"

namespace diurna {

/// Adds what is at the pixels' centres: temperature, range, facet, object, material, normal.
void add_truth(const View& view, const RadianceInput& input, Frame& frame);

}  // namespace diurna
