#pragma once

#include <string>
#include <vector>

#include "materials/matter/library.hpp"
#include "scenes/world/world.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// (facet of World::surfaces()) share of rain and snow, falling straight down, that nothing above
/// keeps off it, 0 to 1: the mean of 16 points of the facet, one upright ray each. Roofs, panes and
/// crowns let none through, a net what it does not cover; what runs off them falls nowhere.
///
/// Empty, and no ray is cast, where no rain falls or nothing but ground is there.
std::vector<float> open_above(const World& world, const MaterialLibrary& materials,
                              const Weather& weather);

/// In one line on how many surfaces less falls than in the open, and that none does in flight;
/// empty where it rains on all alike.
std::string rain_note(const World& world, const MaterialLibrary& materials, const Weather& weather,
                      const std::vector<float>& open);

}  // namespace diurna
