#include <fmt/format.h>

#include <cmath>

#include "scenes/job/warnings/scene_warnings.hpp"

namespace diurna {

std::vector<Mistake> place_warnings(const Prepared& prepared) {
    const Scene& scene = prepared.scene;
    const Eigen::Vector2d here(prepared.world.site.longitude_deg, prepared.world.site.latitude_deg);
    std::vector<Mistake> warnings;
    const auto look = [&](const std::string& key, const Eigen::Vector2d& place) {
        constexpr double near = 0.3;  // [deg] both ways at once: metres are seldom so by chance
        const bool straight = (place - here).cwiseAbs().maxCoeff() < near;
        const bool turned = (place.reverse() - here).cwiseAbs().maxCoeff() < near;
        if ((!straight && !turned) || place.norm() < 1.0) return;
        warnings.push_back(
            {scene.file.string() + ": " + key,
             fmt::format(
                 "[{:g}, {:g}] look like {}, but are read as metres east and north of the site",
                 place.x(), place.y(),
                 straight ? "longitude and latitude" : "latitude and longitude"),
             "for latitude and longitude write place = [latitude, longitude]"});
    };
    for (const ObserverInput& observer : scene.observers) {
        const bool stands = !observer.around && observer.on.empty() && !observer.goes();
        if (stands) look("observer." + observer.name + ".place_m", observer.place);
        if (observer.look_at) look("observer." + observer.name + ".look_at_m", *observer.look_at);
    }
    for (const ObjectInput& object : scene.terrain.objects) {
        if (object.trajectory.empty()) look("object." + object.name + ".place_m", object.place);
    }
    for (const Building& building : scene.terrain.buildings) {
        look("building." + building.name + ".place_m", building.place);
    }
    for (const GroundPolygon& polygon : scene.terrain.polygons) {
        if (!polygon.ring.empty()) look("ground." + polygon.name, polygon.ring.front());
    }
    return warnings;
}

}  // namespace diurna
