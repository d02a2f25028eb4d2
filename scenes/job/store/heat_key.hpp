#pragma once

#include <string>
#include <vector>

#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/store/inputs.hpp"

namespace diurna {

/// Key of the temperatures of a scene that is unchanged since it was read, for any stored instants:
/// from the content of what the heat balance takes (scenes/job/store/heat_content.hpp). If pictures
/// determine what is solved (tolerance_K), the scene file except tables used only by pictures, all
/// other inputs, and the pictures' poses and instants are included; if objects move, the whole
/// file.
///
/// - inputs: of the run
/// - tolerance: [K] of the solution (scenes/job/run/heat.hpp)
std::string heat_key(const Prepared& prepared, const std::vector<RunInput>& inputs,
                     double tolerance);

/// Key of what the surface check (scenes/job/run/check_points.hpp) draws its places from: poses and
/// instants of the pictures, samples, seed, number of places.
std::string pictures_key(const Prepared& prepared);

}  // namespace diurna
