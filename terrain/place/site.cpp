#include "terrain/place/site.hpp"

#include <GeographicLib/LocalCartesian.hpp>
#include <cassert>
#include <cmath>

#include "materials/air/sight_line.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

GeographicLib::LocalCartesian frame_of(const Site& site) {
    assert(std::isfinite(site.height) && std::abs(site.latitude_deg) <= 90.0 &&
           std::isfinite(site.longitude_deg));
    return {site.latitude_deg, site.longitude_deg, site.height};
}

constexpr double earth_radius = 6371e3;  // [m] mean, by which refraction's k is defined

/// What refraction lifts a point by that is so far east and north.
double lift(const Site& site, const Eigen::Vector3d& local) {
    return site.refraction * local.head<2>().squaredNorm() / (2.0 * earth_radius);
}

Eigen::Vector3d forward(const Site& site, const GeographicLib::LocalCartesian& frame,
                        const Geodetic& place) {
    Eigen::Vector3d local;
    frame.Forward(place.latitude_deg, place.longitude_deg, place.height, local.x(), local.y(),
                  local.z());
    local.z() += lift(site, local);
    return local;
}

}  // namespace

void to_local(const Site& site, std::span<const Geodetic> places,
              std::span<Eigen::Vector3d> local) {
    assert(places.size() == local.size());
    const auto frame = frame_of(site);
    for (std::size_t i = 0; i < places.size(); ++i) local[i] = forward(site, frame, places[i]);
}

Eigen::Vector3d to_local(const Site& site, const Geodetic& place) {
    return forward(site, frame_of(site), place);
}

Geodetic to_geodetic(const Site& site, const Eigen::Vector3d& local) {
    Geodetic place{};
    frame_of(site).Reverse(local.x(), local.y(), local.z() - lift(site, local), place.latitude_deg,
                           place.longitude_deg, place.height);
    return place;
}

double level_height(const Eigen::Vector3d& place) {
    return place.z() + place.head<2>().squaredNorm() / (2e3 * earth_radius_km);
}

Eigen::Vector3d direction(double azimuth_deg, double elevation_deg) {
    const double a = radians(azimuth_deg), e = radians(elevation_deg);
    return {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
}

}  // namespace diurna
