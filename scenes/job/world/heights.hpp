#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "materials/air/air_by_height.hpp"
#include "scenes/job/input/read_height.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/raster/dem.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

// Heights above the sea, and their use for the air of a scene.

/// Height [m] above the sea of a place in the world's frame, whose plane touches the earth at the
/// site.
double height_above_sea(const World& world, const Eigen::Vector3d& place);

/// Position of something given by its place and height: east, north, up [m]. Throws
/// InputError(where) for a height above ground where there is no ground; one above the sea or the
/// ellipsoid may be anywhere.
Eigen::Vector3d stand_point(const World& world, const Dem& dem, const Eigen::Vector2d& place,
                            const HeightInput& height, const std::string& where);
/// The `up` coordinate [m] for a height that is not above the ground.
double up_of(const World& world, const Eigen::Vector2d& place, const HeightInput& height);

/// For every surface's centroid: (facet of World::surfaces()).
std::vector<float> facet_heights(const World& world);

/// The lowest and the highest corner of all surfaces [m]; the site's without surfaces.
struct HeightSpan {
    double low, high;
};
HeightSpan heights_of_surfaces(const World& world);
/// The same for the ground only, which determines the weather's air: flying objects do not affect
/// it.
HeightSpan heights_of_ground(const World& world);

/// From the weather's station to any height, as given in the scene's [weather]: for facets and for
/// lines of sight.
AirByHeight air_by_height(const Scene& scene, const Weather& weather);

/// A note for the report: how far the surfaces are from the station's height, and that cold pools
/// in hollows far below it are not modelled. Empty on level ground.
std::string height_note(const Scene& scene, const World& world, const Weather& weather);

}  // namespace diurna
