#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "materials/matter/library.hpp"
#include "scenes/world/world.hpp"
#include "terrain/visibility/object_parts.hpp"
#include "thermal/surface/plate_film.hpp"

namespace diurna {

/// What every surface is to the wind: (facet of World::surfaces()).
///
/// - Surfaces of buildings and objects: the sizes of their parts (terrain/visibility/
///   object_parts.hpp), and the wind at their middle's height over the raster's ground
///   (thermal/weather/wind_share.hpp); `louis`, which has a profile of its own, as it is measured.
///   What is in flight has a wind of its own.
/// - All of them and the ground: less wind in the lee of other bodies, the mean of 16 directions,
///   in each the body that takes most off; a copy is one body, as the box round it. Ground out of
///   their reach has a share of exactly 1.
///
/// Empty where there are neither buildings nor objects.
///
/// wind_height  [m] at which the weather's wind was measured
std::vector<FilmPart> parts_in_wind(const World& world, const MaterialLibrary& materials,
                                    double wind_height);

/// The box round some facets, its length along their longest axis in plan.
BodyBox box_round(const FacetSet& facets, std::size_t first, std::size_t count);
/// The same in another place, but for a turn about the vertical alone.
BodyBox placed_box(BodyBox box, const Eigen::Isometry3d& pose);

/// (box) share of the wind at its middle in the lee of the other boxes and of what the world has
/// outside it, as above.
std::vector<float> wind_at_boxes(const World& world, std::span<const BodyBox> boxes);

/// In one line how much of the ground lies in the lee; empty where none does.
std::string lee_note(const World& world, const std::vector<FilmPart>& parts);

}  // namespace diurna
