#pragma once

#include <Eigen/Core>
#include <span>

namespace diurna {

/// The scene's place: the geodetic origin of its local east-north-up frame (WGS84).
struct Site {
    double latitude_deg = 0.0;   // −90 to 90
    double longitude_deg = 0.0;  // −180 to 180
    double height = 0.0;         // above the ellipsoid [m]
    /// Coefficient k of terrestrial refraction: the curvature of a level line of sight divided by
    /// that of the Earth; 0.13 on an ordinary day (Gauss), 0 without air.
    double refraction = 0.0;
};

struct Geodetic {
    double latitude_deg, longitude_deg, height;  // height above the ellipsoid [m]
};

/// Geodetic places to east, north, up [m] in the frame of the site, curvature included; and back.
/// Exact to 1 µm within 100 km (GeographicLib::LocalCartesian).
///
/// With refraction, `up` has k (east² + north²) / 2R added, R = 6371 km. This turns every line of
/// sight that the air bends by k/R into a straight line, between any two places: horizons, shadows
/// and pictures need no further correction. The verticals of far places tilt away by k times the
/// tilt due to the Earth's curvature, 0.06° at 50 km.
void to_local(const Site& site, std::span<const Geodetic> places, std::span<Eigen::Vector3d> local);
Eigen::Vector3d to_local(const Site& site, const Geodetic& place);
Geodetic to_geodetic(const Site& site, const Eigen::Vector3d& local);

/// Height [m] of a place in the east-north-up frame above the level surface through the origin:
/// z + (x² + y²) / 2R with the radius of the atmosphere's shells (materials/air/sight_line.hpp).
/// 5 µm more than over a sphere at 10 km, 5 cm at 100 km.
double level_height(const Eigen::Vector3d& place);

/// Unit vector towards an azimuth (clockwise from true north) and elevation, in east-north-up.
Eigen::Vector3d direction(double azimuth_deg, double elevation_deg);

}  // namespace diurna
