#pragma once

#include <Eigen/Core>
#include <span>

namespace diurna {

/// The scene's place: the geodetic origin of its local east-north-up frame (WGS84).
struct Site {
    double latitude_deg = 0.0;   // −90 to 90
    double longitude_deg = 0.0;  // −180 to 180
    double height = 0.0;         // above the ellipsoid [m]
};

struct Geodetic {
    double latitude_deg, longitude_deg, height;  // height above the ellipsoid [m]
};

/// Geodetic places to east, north, up [m] in the frame of the site, curvature included; and back.
/// Exact to 1 µm within 100 km (GeographicLib::LocalCartesian).
void to_local(const Site& site, std::span<const Geodetic> places, std::span<Eigen::Vector3d> local);
Eigen::Vector3d to_local(const Site& site, const Geodetic& place);
Geodetic to_geodetic(const Site& site, const Eigen::Vector3d& local);

/// Unit vector towards an azimuth (clockwise from true north) and elevation, in east-north-up.
Eigen::Vector3d direction(double azimuth_deg, double elevation_deg);

}  // namespace diurna
