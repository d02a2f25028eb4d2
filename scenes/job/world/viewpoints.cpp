#include "scenes/job/world/viewpoints.hpp"

#include <algorithm>

#include "materials/base/units.hpp"
#include "scenes/job/world/ground_point.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/ways.hpp"
#include "terrain/ground/level_of_detail.hpp"
#include "terrain/raster/dem_places.hpp"

namespace diurna {

namespace {

/// Height over the ground below [m], over the site's level where there is none.
double height_over_ground(const Eigen::Vector3d& at, const Dem& dem, const World& world) {
    const auto ground = ground_if_any(dem, world.site, at.head<2>());
    return at.z() - (ground ? ground->z() : 0.0);
}

double height_over_ground(const ObserverInput& observer, const Dem& dem, const World& world) {
    if (observer.stands.over == HeightOver::ground) return observer.stands.metres;
    const double up = up_of(world, observer.place, observer.stands);
    return height_over_ground({observer.place.x(), observer.place.y(), up}, dem, world);
}

/// East, north and height above the ground of some of its frames' places [m].
std::vector<Eigen::Vector3d> places_on_way(const ObserverInput& observer, const Scene& scene,
                                           const Dem& dem, const World& world) {
    constexpr std::size_t most = 32;
    const TrajectoryInput& input = *find_trajectory(scene.trajectories, observer.trajectory);
    const Way way(input, dem, world);
    std::vector<Eigen::Vector3d> places;
    const std::size_t count = observer.frames.size(), shown = std::min(most, count);
    for (std::size_t i = 0; i < shown; ++i) {
        const std::size_t frame = shown < 2 ? 0 : i * (count - 1) / (shown - 1);
        Eigen::Vector3d at = way.at(observer.frames[frame]).place;
        at.z() = height_over_ground(at, dem, world);
        places.push_back(at);
    }
    return places;
}

}  // namespace

std::vector<float> slack_of(const Scene& scene, const Dem& dem, const World& world) {
    if (!(scene.terrain.coarsest > scene.terrain.elevation.tolerance)) return {};
    std::vector<Viewpoint> viewpoints;
    const auto add = [&](const Eigen::Vector2d& place, double height, double angle) {
        viewpoints.push_back({raster_places(dem, world.site, {&place, 1}).front(), height, angle});
    };
    for (const ObserverInput& observer : scene.observers) {
        const double pixel = radians(observer.horizontal_fov_deg) / observer.width;
        if (!observer.goes()) {
            add(observer.place, height_over_ground(observer, dem, world), pixel);
            continue;
        }
        for (const Eigen::Vector3d& at : places_on_way(observer, scene, dem, world)) {
            add(at.head<2>(), at.z(), pixel);
        }
    }
    for (const Building& building : scene.terrain.buildings) add(building.place, 0.0, 0.01);
    for (const ObjectInput& object : scene.terrain.objects) add(object.place, 0.0, 0.01);
    for (const GroundPolygon& polygon : scene.terrain.polygons) {
        for (const Eigen::Vector2d& corner : polygon.ring) add(corner, 0.0, 0.01);
    }
    return level_of_detail(dem, viewpoints, std::max(scene.terrain.elevation.tolerance, 1e-3),
                           scene.terrain.coarsest);
}

}  // namespace diurna
