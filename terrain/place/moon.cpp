#include "terrain/place/moon.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "materials/base/units.hpp"
#include "terrain/place/celestial.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

MoonLight moon_light(const Eigen::Vector3d& moon, const Eigen::Vector3d& sun,
                     const Eigen::Vector3d& observer) {
    constexpr double km_per_au = 149597870.7;  // IAU 2012
    const Eigen::Vector3d to_sun = sun - moon, to_observer = observer - moon;
    return {
        .phase_deg = degrees(std::atan2(to_sun.cross(to_observer).norm(), to_sun.dot(to_observer))),
        .distance_km = km_per_au * to_observer.norm(),
        .sun_distance_au = to_sun.norm()};
}

MoonPosition moon_position(const Site& site, Instant instant) {
    const Eigen::Vector3d moon = from_site(site, moon_from_earth(instant));
    const Eigen::Vector3d sun = from_site(site, sun_from_earth(instant));
    const SunPosition place = sun_at(east_north_up(site, moon));
    return {place.azimuth_deg, place.elevation_deg, moon_light(moon, sun, Eigen::Vector3d::Zero())};
}

}  // namespace diurna
