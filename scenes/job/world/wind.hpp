#pragma once

#include <Eigen/Geometry>
#include <span>
#include <string>
#include <vector>

#include "materials/matter/library.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/visibility/object_parts.hpp"
#include "thermal/surface/plate_film.hpp"

namespace diurna {

/// Wind parameters of every surface: (facet of World::surfaces()).
///
/// - Surfaces of buildings and objects: the sizes of their parts (terrain/visibility/
///   object_parts.hpp), and the wind at their middle's height over the raster's ground
///   (thermal/weather/wind_share.hpp); for `louis`, which includes a profile, the measured wind.
///   In flight: the wind due to its speed.
/// - All of them and the ground: less wind in the lee of other bodies, the mean of 16 directions,
///   in each the body with the largest reduction; a copy is one body, the box around it. Ground
///   out of their reach has a share of exactly 1.
///
/// Empty if there are neither buildings nor objects.
///
/// wind_height  [m] at which the weather's wind was measured
std::vector<FilmPart> parts_in_wind(const World& world, const MaterialLibrary& materials,
                                    double wind_height);

/// The box around some facets, its length along their longest axis in plan.
BodyBox box_round(const FacetSet& facets, std::size_t first, std::size_t count);
/// The same at another place, using only the rotation about the vertical.
BodyBox placed_box(BodyBox box, const Eigen::Isometry3d& pose);

/// (box) share of the wind at its middle in the lee of the other boxes and of everything in the
/// world outside it, as above.
std::vector<float> wind_at_boxes(const World& world, std::span<const BodyBox> boxes);

/// One line on how much of the ground is in the lee; empty if none.
std::string lee_note(const World& world, const std::vector<FilmPart>& parts);

}  // namespace diurna
