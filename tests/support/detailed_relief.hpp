#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_places.hpp"

/// A relief given in metres of one map, as rasters of any lattice.
namespace detailed_relief {

inline constexpr const char* utm_32 = "EPSG:32632";

/// A raster without heights, its first post at (x, y) of the map.
inline diurna::Dem lattice(const std::string& source, const std::string& crs, int columns, int rows,
                           double x, double y, double spacing) {
    diurna::Dem dem;
    dem.source = source;
    dem.columns = columns;
    dem.rows = rows;
    dem.height.assign(std::size_t(columns) * std::size_t(rows), 0.0f);
    dem.transform = {x - 0.5 * spacing, spacing, 0.0, y + 0.5 * spacing, 0.0, -spacing};
    dem.crs_wkt = crs;
    return dem;
}

/// East and north [m] on the map of zone 32 of fractional posts.
inline std::vector<Eigen::Vector2d> on_map(const diurna::Dem& dem,
                                           const std::vector<Eigen::Vector2d>& place) {
    const std::vector<float> level(place.size(), 0.0f);
    const diurna::Dem map = lattice("map", utm_32, 2, 2, 0.0, 0.0, 1.0);
    std::vector<Eigen::Vector2d> found =
        diurna::raster_places(map, diurna::geodetic_places(dem, place, level));
    for (Eigen::Vector2d& p : found) p.y() = -p.y();
    return found;
}

/// Its posts' heights from a surface over that map.
template <class Surface>
diurna::Dem sampled(diurna::Dem dem, const Surface& surface) {
    std::vector<Eigen::Vector2d> place;
    for (int row = 0; row < dem.rows; ++row) {
        for (int column = 0; column < dem.columns; ++column) place.emplace_back(column, row);
    }
    const std::vector<Eigen::Vector2d> at = on_map(dem, place);
    for (std::size_t k = 0; k < at.size(); ++k) dem.height[k] = static_cast<float>(surface(at[k]));
    return dem;
}

/// Seconds of arc in the south of Sweden, 16 m by 31 m.
inline diurna::Dem seconds_lattice() {
    return lattice("coarse.tif", "EPSG:4326", 141, 101, 11.95, 57.70, 1.0 / 3600.0);
}

}  // namespace detailed_relief
