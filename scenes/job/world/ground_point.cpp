#include "scenes/job/world/ground_point.hpp"

#include <fmt/format.h>

#include <cmath>

#include "materials/base/error.hpp"
#include "terrain/raster/dem_places.hpp"

namespace diurna {

std::optional<Eigen::Vector3d> ground_if_any(const Dem& dem, const Site& site,
                                             const Eigen::Vector2d& place) {
    // Up leans away from the vertical with distance: first the ground below the site's plane, then
    // that below the place so high.
    Eigen::Vector3d found(place.x(), place.y(), 0.0);
    for (int pass = 0; pass < 2; ++pass) {
        const Geodetic below = to_geodetic(site, found);
        const double height = height_at(dem, below.latitude_deg, below.longitude_deg);
        if (std::isnan(height)) return std::nullopt;
        found.z() = to_local(site, {below.latitude_deg, below.longitude_deg, height}).z();
    }
    return found;
}

Eigen::Vector3d ground_point(const Dem& dem, const Site& site, const Eigen::Vector2d& place,
                             const std::string& where, const std::string& hint) {
    const auto ground = ground_if_any(dem, site, place);
    if (ground) return *ground;
    throw InputError(
        where,
        fmt::format(
            "east {:g} m, north {:g} m is outside the part of {} that is read, or over a void",
            place.x(), place.y(), dem.source),
        hint);
}

}  // namespace diurna
