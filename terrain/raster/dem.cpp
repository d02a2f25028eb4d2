#include "terrain/raster/dem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "terrain/raster/grid.hpp"

namespace diurna {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// Whether a place lies between posts.
bool is_on(const Dem& dem, const Eigen::Vector2d& place) {
    return place.x() >= 0.0 && place.y() >= 0.0 && place.x() <= dem.columns - 1 &&
           place.y() <= dem.rows - 1;
}

}  // namespace

int detail_at(const Dem& dem, const Eigen::Vector2d& place) {
    for (std::size_t k = dem.detail.size(); k-- > 0;) {
        const DemDetail& detail = dem.detail[k];
        const bool near = (place.array() >= detail.to_own.low.array()).all() &&
                          (place.array() <= detail.to_own.high.array()).all();
        if (near && is_on(detail.raster, detail.to_own(place))) return int(k);
    }
    return -1;
}

bool has_voids(const Dem& dem) {
    return std::any_of(dem.height.begin(), dem.height.end(), [](float h) { return std::isnan(h); });
}

double height_at(const Dem& dem, const Eigen::Vector2d& place) {
    const double x = place.x(), y = place.y();
    if (!is_on(dem, place)) return unknown;
    if (const int k = detail_at(dem, place); k >= 0) {
        const DemDetail& detail = dem.detail[std::size_t(k)];
        return height_at(detail.raster, detail.to_own(place));
    }
    const int column = std::min(static_cast<int>(x), dem.columns - 2);
    const int row = std::min(static_cast<int>(y), dem.rows - 2);
    const double u = x - column, v = y - row;
    const double a = dem.at(row, column), b = dem.at(row, column + 1);
    const double c = dem.at(row + 1, column), d = dem.at(row + 1, column + 1);
    const int voids = std::isnan(a) + std::isnan(b) + std::isnan(c) + std::isnan(d);
    if (voids == 0) return bilinear(a, b, c, d, u, v);
    if (voids > 1) return unknown;
    // One corner is void: the plane through the three others, on their half of the cell.
    constexpr double rounding = 1e-9;
    if (std::isnan(a))
        return u + v >= 1.0 - rounding ? d + (1 - u) * (c - d) + (1 - v) * (b - d) : unknown;
    if (std::isnan(d)) return u + v <= 1.0 + rounding ? a + u * (b - a) + v * (c - a) : unknown;
    if (std::isnan(b)) return v >= u - rounding ? c + u * (d - c) + (1 - v) * (a - c) : unknown;
    return u >= v - rounding ? b + (1 - u) * (a - b) + v * (d - b) : unknown;
}

double nearest_height(const Dem& dem, int row, int column) {
    // Searched in growing squares.
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

}  // namespace diurna
