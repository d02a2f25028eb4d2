#pragma once

#include <Eigen/Core>

#include "materials/atmosphere/moonlight.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

/// The moon's centre as seen from a site, without refraction, and its phase.
struct MoonPosition {
    double azimuth_deg;    // clockwise from true north, 0 to 360
    double elevation_deg;  // up to 1° lower than seen from the earth's centre
    MoonLight light;
};

/// Within 0.005° (Meeus's series: terrain/place/celestial.hpp).
MoonPosition moon_position(const Site& site, Instant instant);

/// From positions of moon, sun and observer in one frame [au].
MoonLight moon_light(const Eigen::Vector3d& moon, const Eigen::Vector3d& sun,
                     const Eigen::Vector3d& observer);

}  // namespace diurna
