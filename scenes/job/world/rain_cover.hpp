#pragma once

#include <string>
#include <vector>

#include "materials/matter/library.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// (facet of World::surfaces()) share of vertical rain and snow that reaches it, 0 to 1: the mean
/// of 16 points of the facet, one vertical ray each. Roofs, panes and crowns block all, a net its
/// covered share; runoff from them is lost.
///
/// Empty, and without rays, if no rain falls or there is only ground.
std::vector<float> open_above(const World& world, const MaterialLibrary& materials,
                              const Weather& weather);

/// One line on the number of surfaces with less rain than in the open, and on none in flight; empty
/// if all receive the same.
std::string rain_note(const World& world, const MaterialLibrary& materials, const Weather& weather,
                      const std::vector<float>& open);

}  // namespace diurna
