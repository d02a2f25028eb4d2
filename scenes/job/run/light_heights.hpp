#pragma once

#include "render/light/radiance_input.hpp"
#include "scenes/job/plan/prepared.hpp"

namespace diurna {

/// Which heights' sun and sky the facets of pictures have, as in the heat balance: one for all with
/// weather.lapse = 0, and a change at the cloud's top.
void set_light_heights(const Prepared& prepared, RadianceInput& input);

}  // namespace diurna
