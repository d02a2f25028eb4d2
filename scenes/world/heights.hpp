#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "materials/air/air_by_height.hpp"
#include "scenes/input/read_height.hpp"
#include "scenes/input/scene.hpp"
#include "scenes/world/world.hpp"
#include "terrain/raster/dem.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

// Heights above the sea, and what the air of a scene does with them.

/// Height [m] above the sea of a place in the world's frame, which is a plane that touches the
/// earth at the site.
double height_above_sea(const World& world, const Eigen::Vector3d& place);

/// Where something stands that is given by its place and height: east, north, up [m]. Throws
/// InputError(where) for one above the ground where there is none; one above the sea or the
/// ellipsoid may be anywhere.
Eigen::Vector3d stand_point(const World& world, const Dem& dem, const Eigen::Vector2d& place,
                            const HeightInput& height, const std::string& where);
/// The same [m] of one that is not above the ground.
double up_of(const World& world, const Eigen::Vector2d& place, const HeightInput& height);

/// Of every surface's middle: (facet of World::surfaces()).
std::vector<float> facet_heights(const World& world);

/// The lowest and the highest corner of all surfaces [m]; the site's where there are none.
struct HeightSpan {
    double low, high;
};
HeightSpan heights_of_surfaces(const World& world);
/// The same of the ground alone, whose air the weather's is: what flies does not lift it.
HeightSpan heights_of_ground(const World& world);

/// From the weather's station to any height, as the scene's [weather] says: for facets and for
/// lines of sight.
AirByHeight air_by_height(const Scene& scene, const Weather& weather);

/// What a reader should know of it: how far the surfaces lie from the station, and that hollows
/// far below it keep no cold air of their own. Empty on level ground.
std::string height_note(const Scene& scene, const World& world, const Weather& weather);

}  // namespace diurna
