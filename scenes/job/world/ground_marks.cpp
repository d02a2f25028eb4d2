#include "scenes/job/world/ground_marks.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "terrain/raster/dem_places.hpp"

namespace diurna {

namespace {

/// Whether a triangle of raster places holds a post without elevation in the file; one that holds
/// no post at all, whether its middle's cell has such a one.
bool over_void(const Dem& dem, const std::array<Eigen::Vector2d, 3>& corner) {
    const auto is_void = [&](int row, int column) {
        return !dem.is_void.empty() && row >= 0 && column >= 0 && row < dem.rows &&
               column < dem.columns && dem.is_void[std::size_t(row) * dem.columns + column];
    };
    Eigen::Matrix2d edges;
    edges << corner[1] - corner[0], corner[2] - corner[0];
    const Eigen::Matrix2d inverse = edges.inverse();
    const Eigen::Vector2d low = corner[0].cwiseMin(corner[1]).cwiseMin(corner[2]);
    const Eigen::Vector2d high = corner[0].cwiseMax(corner[1]).cwiseMax(corner[2]);
    bool any = false;
    constexpr double near = 1e-3;  // places come from metres kept as float
    for (int row = int(std::ceil(low.y() - near)); row <= int(high.y() + near); ++row) {
        for (int column = int(std::ceil(low.x() - near)); column <= int(high.x() + near);
             ++column) {
            const Eigen::Vector2d at = inverse * (Eigen::Vector2d(column, row) - corner[0]);
            if (at.minCoeff() < -near || at.sum() > 1.0 + near) continue;
            if (is_void(row, column)) return true;
            any = true;
        }
    }
    const Eigen::Vector2d middle = (corner[0] + corner[1] + corner[2]) / 3.0;
    const int left = int(std::floor(middle.x())), above = int(std::floor(middle.y()));
    return !any && (is_void(above, left) || is_void(above, left + 1) || is_void(above + 1, left) ||
                    is_void(above + 1, left + 1));
}

/// Fractional posts of points in the site's frame [m].
template <class Points>
std::vector<Eigen::Vector2d> posts_of(const Dem& dem, const Site& site, const Points& points) {
    std::vector<Geodetic> places;
    for (const Eigen::Vector3f& p : points) places.push_back(to_geodetic(site, p.cast<double>()));
    return raster_places(dem, places);
}

}  // namespace

void mark_details(World& world, const Dem& dem) {
    if (dem.detail.empty()) return;
    const std::span<const Eigen::Vector3f> centroids(world.facets.centroid);
    const auto middle = posts_of(dem, world.site, centroids.first(world.ground_facets));
    for (const Eigen::Vector2d& p : middle) world.on_detail.push_back(detail_at(dem, p) >= 0);
}

void mark_filled(World& world, const Dem& dem) {
    const bool none = dem.is_void.empty() &&
                      std::all_of(dem.detail.begin(), dem.detail.end(),
                                  [](const DemDetail& d) { return d.raster.is_void.empty(); });
    if (none) return;
    const auto place = posts_of(dem, world.site, world.facets.vertex);
    std::vector<std::uint8_t> filled(world.facets.size(), 0);
    for (std::size_t f = 0; f < world.ground_facets; ++f) {
        const auto& [a, b, c] = world.facets.corner[f];
        std::array<Eigen::Vector2d, 3> corner{place[a], place[b], place[c]};
        const Eigen::Vector2d middle = (corner[0] + corner[1] + corner[2]) / 3.0;
        const int k = detail_at(dem, middle);
        if (k >= 0) {
            for (Eigen::Vector2d& p : corner) p = dem.detail[std::size_t(k)].to_own(p);
        }
        filled[f] = over_void(k < 0 ? dem : dem.detail[std::size_t(k)].raster, corner);
        world.filled_facets += filled[f];
    }
    if (world.filled_facets > 0) world.filled = std::move(filled);
}

}  // namespace diurna
