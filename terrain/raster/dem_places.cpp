#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/raster/dem.hpp"

namespace diurna {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

Geodetic place_of(const Dem& dem, const Eigen::Vector2d& place, double height) {
    const auto h = static_cast<float>(height);
    return geodetic_places(dem, {&place, 1}, {&h, 1}).front();
}

/// The valid post nearest to a place, searched in growing squares.
double nearest_height(const Dem& dem, int row, int column) {
    for (int reach = 0; reach < std::max(dem.rows, dem.columns); ++reach) {
        double best = unknown;
        int best_squared = std::numeric_limits<int>::max();
        for (int r = std::max(0, row - reach); r <= std::min(dem.rows - 1, row + reach); ++r) {
            for (int c = std::max(0, column - reach);
                 c <= std::min(dem.columns - 1, column + reach); ++c) {
                const int squared = (r - row) * (r - row) + (c - column) * (c - column);
                if (squared < best_squared && !std::isnan(dem.at(r, c))) {
                    best_squared = squared;
                    best = dem.at(r, c);
                }
            }
        }
        if (!std::isnan(best)) return best;
    }
    return unknown;
}

}  // namespace

std::vector<Geodetic> post_places(const Dem& dem) {
    std::vector<Eigen::Vector2d> place;
    place.reserve(dem.height.size());
    for (int row = 0; row < dem.rows; ++row) {
        for (int column = 0; column < dem.columns; ++column) place.emplace_back(column, row);
    }
    return geodetic_places(dem, place, dem.height);
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
    return place_of(dem, middle, nearest_height(dem, dem.rows / 2, dem.columns / 2));
}

double height_at(const Dem& dem, const Eigen::Vector2d& place) {
    const double x = place.x(), y = place.y();
    if (!(x >= 0.0 && y >= 0.0 && x <= dem.columns - 1 && y <= dem.rows - 1)) return unknown;
    const int column = std::min(static_cast<int>(x), dem.columns - 2);
    const int row = std::min(static_cast<int>(y), dem.rows - 2);
    const double u = x - column, v = y - row;
    const double a = dem.at(row, column), b = dem.at(row, column + 1);
    const double c = dem.at(row + 1, column), d = dem.at(row + 1, column + 1);
    const int voids = std::isnan(a) + std::isnan(b) + std::isnan(c) + std::isnan(d);
    if (voids == 0) return (1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d);
    if (voids > 1) return unknown;
    // One corner is void: the plane through the three others, on their half of the cell.
    constexpr double rounding = 1e-9;
    if (std::isnan(a))
        return u + v >= 1.0 - rounding ? d + (1 - u) * (c - d) + (1 - v) * (b - d) : unknown;
    if (std::isnan(d)) return u + v <= 1.0 + rounding ? a + u * (b - a) + v * (c - a) : unknown;
    if (std::isnan(b)) return v >= u - rounding ? c + u * (d - c) + (1 - v) * (a - c) : unknown;
    return u >= v - rounding ? b + (1 - u) * (a - b) + v * (d - b) : unknown;
}

double height_at(const Dem& dem, double latitude_deg, double longitude_deg) {
    const Geodetic place{latitude_deg, longitude_deg, 0.0};
    return height_at(dem, raster_places(dem, {&place, 1}).front());
}

}  // namespace diurna
