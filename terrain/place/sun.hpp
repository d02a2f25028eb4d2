#pragma once

#include <Eigen/Core>

#include "materials/base/units.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// Topocentric position of the sun's centre.
struct SunPosition {
    double azimuth_deg;    // clockwise from true north, 0 to 360
    double elevation_deg;  // geometric, or refracted if the air was given
    double distance_au;
};

/// Sun seen from the site at an instant, without refraction. 0.5″ worst against NREL's SPA
/// (ERFA: Earth of Epv00, IAU 2000B precession-nutation, aberration, topocentric parallax).
SunPosition sun_position(const Site& site, Instant instant);

/// The same with refraction by air of the given pressure [hPa] and temperature [°C]
/// (Sæmundsson-Meeus as in SPA; none below −0.83°).
SunPosition sun_position(const Site& site, Instant instant, double pressure_hPa,
                         double temperature_C);

/// Adds that refraction to a position without it: for positions interpolated between a few computed
/// ones.
SunPosition refracted(SunPosition sun, double pressure_hPa, double temperature_C);

/// The sun's position from its vector east, north, up [au] as seen from the site.
SunPosition sun_at(const Eigen::Vector3d& place);

/// Unit vector towards the sun in the site's east-north-up frame.
Eigen::Vector3d sun_direction(const SunPosition& sun);

inline constexpr double sun_angular_radius = radians(0.2666);  // [rad] at 1 AU

}  // namespace diurna
