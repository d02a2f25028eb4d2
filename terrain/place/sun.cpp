#include "terrain/place/sun.hpp"

#include <cmath>

#include "materials/base/units.hpp"
#include "terrain/place/celestial.hpp"

namespace diurna {

SunPosition sun_position(const Site& site, Instant instant) {
    const Eigen::Vector3d sun = from_site(site, sun_from_earth(instant));
    SunPosition position = sun_at(east_north_up(site, sun));
    position.distance_au = sun.norm();  // without the turn's rounding
    return position;
}

SunPosition sun_at(const Eigen::Vector3d& place) {
    double azimuth_deg = degrees(std::atan2(place.x(), place.y()));
    if (azimuth_deg < 0.0) azimuth_deg += 360.0;
    return {azimuth_deg, degrees(std::atan2(place.z(), std::hypot(place.x(), place.y()))),
            place.norm()};
}

SunPosition sun_position(const Site& site, Instant instant, double pressure_hPa,
                         double temperature_C) {
    return refracted(sun_position(site, instant), pressure_hPa, temperature_C);
}

SunPosition refracted(SunPosition sun, double pressure_hPa, double temperature_C) {
    const double upper_limb_at_horizon_deg = -0.26667 - 0.5667;
    if (sun.elevation_deg >= upper_limb_at_horizon_deg) {
        const double e = sun.elevation_deg;
        sun.elevation_deg += (pressure_hPa / 1010.0) * (283.0 / (273.0 + temperature_C)) * 1.02 /
                             (60.0 * std::tan(radians(e + 10.3 / (e + 5.11))));
    }
    return sun;
}

Eigen::Vector3d sun_direction(const SunPosition& sun) {
    return direction(sun.azimuth_deg, sun.elevation_deg);
}

}  // namespace diurna
