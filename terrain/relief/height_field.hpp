#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "terrain/place/site.hpp"
#include "terrain/raster/dem.hpp"
#include "terrain/relief/march.hpp"

namespace diurna {

/// Relief as heights over a regular grid, with exact horizons, sun and sky of its posts
/// (horizon.hpp, relief_sun.hpp, relief_sky.hpp). The surface is the grid's triangles: every
/// cell is cut from its first to its last corner, (column, row) to (column + 1, row + 1). Paths
/// in one direction cross the grid's lines and diagonals at the same relative places from every
/// post, so 64 neighbours are followed together (march.hpp); stretches of a path without terrain
/// high enough to matter are skipped. Exact to float rounding: horizons within 0.0005° of robust
/// rays.
///
/// Heights are `up` of the scene's frame, so they include the curvature of the Earth. The plan may
/// be curved (a grid of latitudes and longitudes): a path starts in the right direction at each
/// tile of 64 × 64 posts and runs straight in the grid, 0.04° off after 15 km at 36° north. Beyond
/// the edge of the grid nothing blocks; voids neither block nor have a horizon.
class HeightField {
 public:
    /// `up` (row, column) [m], NaN at voids; `plan`: east and north [m] of the nine posts at the
    /// corners, the middles of the sides and the middle, row by row; quadratic between them. Rows
    /// must turn clockwise from columns seen from above (east and south). Throws InputError for
    /// less than 2 × 2 posts and any other plan.
    HeightField(int columns, int rows, std::span<const float> up,
                const std::array<Eigen::Vector2d, 9>& plan);
    /// The same plan with other heights.
    HeightField with_heights(std::span<const float> up) const {
        return {columns_, rows_, up, plan_};
    }

    int columns() const { return columns_; }
    int rows() const { return rows_; }
    std::size_t size() const { return std::size_t(columns_) * rows_; }
    float up(int row, int column) const { return up_[offset(row, column)]; }  // no_ground: void

    /// East and north [m] of fractional (column, row), and back.
    Eigen::Vector2d place(const Eigen::Vector2d& post) const;
    Eigen::Vector2d post(const Eigen::Vector2d& east_north) const;
    /// ∂(east, north)/∂(column, row) [m].
    Eigen::Matrix2d jacobian(const Eigen::Vector2d& post) const;
    /// Unit normal at a post: the mean of its triangles', by area. Straight up over voids.
    Eigen::Vector3f normal(int row, int column) const;

    /// For the march (tile_march.hpp).
    MarchField march_field() const;
    std::ptrdiff_t pitch() const { return pitch_; }

 private:
    std::size_t offset(int row, int column) const;
    void fill_windows();

    int columns_, rows_;
    std::ptrdiff_t pitch_;
    std::vector<float> up_;      // with a border
    std::vector<float> window_;  // highest post of each window
    int window_columns_ = 0, window_rows_ = 0;
    float highest_ = no_ground;
    std::array<Eigen::Vector2d, 9> plan_;
};

/// The relief of a raster in the frame of a site.
HeightField height_field(const Dem& dem, const Site& site);

}  // namespace diurna
