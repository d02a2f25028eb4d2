#pragma once

#include <vector>

#include "terrain/raster/dem_places.hpp"

namespace diurna {

/// Geodetic places of every post, (row, column).
inline std::vector<Geodetic> post_places(const Dem& dem) {
    std::vector<Eigen::Vector2d> place;
    for (int row = 0; row < dem.rows; ++row) {
        for (int column = 0; column < dem.columns; ++column) place.emplace_back(column, row);
    }
    return geodetic_places(dem, place, dem.height);
}

}  // namespace diurna
