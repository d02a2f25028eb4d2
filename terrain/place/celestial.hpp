#pragma once

#include <Eigen/Core>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

// Positions of sun and moon from the earth's centre [au], in the frame that rotates with the earth:
// x towards Greenwich's meridian, z along the axis (ERFA, IAU 2000B precession-nutation). UT1 is
// taken as UTC: they differ by less than 0.9 s, 0.004° of hour angle and, on average over a year,
// much less.

/// Apparent position, with aberration by the earth's motion: cubic between half days of terrestrial
/// time, 2.2e-10 rad and 4e-10 au from ERFA's own (40 000 instants from 2016 to 2026).
Eigen::Vector3d sun_from_earth(Instant instant);

/// Apparent position: Meeus's (1998) series of ELP 2000, with light travel time; 10″ in longitude,
/// 4″ in latitude, 20 km in distance (ERFA's Moon98 against DE405: 1.3″, 0.6″, 6 km rms).
Eigen::Vector3d moon_from_earth(Instant instant);

/// The same seen from a site at its height: minus the site's position, same axes.
Eigen::Vector3d from_site(const Site& site, const Eigen::Vector3d& place);
/// Rotates such a vector to the site's east, north, up.
Eigen::Vector3d east_north_up(const Site& site, const Eigen::Vector3d& vector);

}  // namespace diurna
