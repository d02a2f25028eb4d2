#pragma once

#include <string>
#include <vector>

#include "materials/matter/library.hpp"
#include "scenes/world/world.hpp"
#include "thermal/surface/plate_film.hpp"

namespace diurna {

/// What every surface is to the wind: (facet of World::surfaces()).
///
/// - Surfaces of buildings and objects: the sizes of their parts (terrain/visibility/
///   object_parts.hpp), and the wind at their middle's height over the raster's ground
///   (thermal/weather/wind_share.hpp); `louis`, which has a profile of its own, as it is measured.
///   What is in flight has a wind of its own.
/// - All of them and the ground: less wind in the lee of other bodies, the mean of 16 directions,
///   in each the body that takes most off. Ground out of their reach has a share of exactly 1.
///
/// Empty where there are neither buildings nor objects.
///
/// wind_height  [m] at which the weather's wind was measured
std::vector<FilmPart> parts_in_wind(const World& world, const MaterialLibrary& materials,
                                    double wind_height);

/// In one line how much of the ground lies in the lee; empty where none does.
std::string lee_note(const World& world, const std::vector<FilmPart>& parts);

}  // namespace diurna
