#include "terrain/raster/dem_places.hpp"

#include <cmath>
#include <limits>

#include "terrain/raster/crs.hpp"
#include "terrain/raster/geotransform.hpp"
#include "terrain/raster/quiet_gdal.hpp"

namespace diurna {

namespace {

constexpr double no_height = std::numeric_limits<double>::quiet_NaN();

}  // namespace

std::vector<Geodetic> geodetic_places(const Dem& dem, std::span<const Eigen::Vector2d> place,
                                      std::span<const float> height) {
    const QuietGdal gdal;
    std::vector<double> x(place.size()), y(place.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
        const Eigen::Vector2d pixel = place[i].array() + 0.5;  // posts are pixel centres
        const Eigen::Vector2d at = map_place(dem.transform, pixel);
        x[i] = at.x();
        y[i] = at.y();
    }
    const GeoProjection& projection = projection_of(dem.crs_wkt, dem.source);
    const std::vector<int> good = transform(*projection.to_geodetic, x, y);
    std::vector<Geodetic> geodetic(place.size());
    for (std::size_t i = 0; i < place.size(); ++i) {
        geodetic[i] = {good[i] ? y[i] : no_height, good[i] ? x[i] : no_height, height[i]};
    }
    return geodetic;
}

std::vector<Eigen::Vector2d> raster_places(const Dem& dem, std::span<const Geodetic> places) {
    const QuietGdal gdal;
    const GeoProjection& projection = projection_of(dem.crs_wkt, dem.source);
    std::vector<double> x(places.size()), y(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        x[i] = places[i].longitude_deg;
        y[i] = places[i].latitude_deg;
    }
    const std::vector<int> good = transform(*projection.from_geodetic, x, y);
    const auto& t = dem.transform;
    const double middle = t[0] + 0.5 * (t[1] * dem.columns + t[2] * dem.rows);
    std::vector<Eigen::Vector2d> raster(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (!good[i]) {
            raster[i].setConstant(no_height);
            continue;
        }
        // Across the date line the same meridian has two numbers: take the one near the raster.
        if (projection.geographic) x[i] += 360.0 * std::round((middle - x[i]) / 360.0);
        raster[i] = pixel_at(t, x[i], y[i]).array() - 0.5;
    }
    return raster;
}

std::vector<Eigen::Vector3d> local_vertices(const Dem& dem, const Site& site,
                                            std::span<const Eigen::Vector2d> place,
                                            std::span<const float> height) {
    const auto places = geodetic_places(dem, place, height);
    std::vector<Eigen::Vector3d> local(places.size());
    to_local(site, places, local);
    return local;
}

std::vector<Eigen::Vector2d> raster_places(const Dem& dem, const Site& site,
                                           std::span<const Eigen::Vector2d> east_north) {
    // The local vertical leans away from the geodetic one with distance, so east and north of a
    // point depend on its height: start on the site's plane, then go to the ground found below.
    std::vector<Geodetic> places(east_north.size());
    std::vector<Eigen::Vector2d> raster;
    std::vector<double> up(east_north.size(), 0.0);
    for (int pass = 0; pass < 3; ++pass) {
        for (std::size_t i = 0; i < east_north.size(); ++i) {
            places[i] = to_geodetic(site, {east_north[i].x(), east_north[i].y(), up[i]});
        }
        raster = raster_places(dem, places);
        for (std::size_t i = 0; i < east_north.size(); ++i) {
            const double height = height_at(dem, raster[i]);
            if (std::isnan(height)) continue;
            places[i].height = height;
            up[i] = to_local(site, places[i]).z();
        }
    }
    return raster;
}

Eigen::Vector2d post_spacing(const Dem& dem) {
    const Eigen::Vector2d middle(0.5 * (dem.columns - 1), 0.5 * (dem.rows - 1));
    const Eigen::Vector2d places[] = {
        middle - Eigen::Vector2d(0.5, 0.0), middle + Eigen::Vector2d(0.5, 0.0),
        middle - Eigen::Vector2d(0.0, 0.5), middle + Eigen::Vector2d(0.0, 0.5)};
    const float heights[4] = {};
    const auto geodetic = geodetic_places(dem, places, heights);
    const Site site{geodetic[0].latitude_deg, geodetic[0].longitude_deg, 0.0};
    const Site other{geodetic[2].latitude_deg, geodetic[2].longitude_deg, 0.0};
    return {to_local(site, geodetic[1]).norm(), to_local(other, geodetic[3]).norm()};
}

Geodetic dem_centre(const Dem& dem) {
    const Eigen::Vector2d middle(0.5 * (dem.columns - 1), 0.5 * (dem.rows - 1));
    const auto height = static_cast<float>(nearest_height(dem, dem.rows / 2, dem.columns / 2));
    return geodetic_places(dem, {&middle, 1}, {&height, 1}).front();
}

double height_at(const Dem& dem, double latitude_deg, double longitude_deg) {
    const Geodetic place{latitude_deg, longitude_deg, 0.0};
    return height_at(dem, raster_places(dem, {&place, 1}).front());
}

}  // namespace diurna
