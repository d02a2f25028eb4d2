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

/// Relief as heights over a regular grid, with exact answers to what stands between a post and the
/// sky. The surface is the grid's triangles: every cell is cut from its first to its last corner,
/// (column, row) to (column + 1, row + 1). The ways of one direction cross the grid's lines and
/// diagonals at the same relative places whatever post they start from, so 64 neighbours are
/// followed together (march.hpp); stretches of the way where nothing is high enough to matter are
/// passed over. Exact up to float rounding: horizons within 0.0005° of robust rays.
///
/// Heights are `up` of the scene's frame, so the curvature of the Earth is in them. The plan may be
/// bent (a grid of latitudes and longitudes): a way starts in the right direction at each tile of
/// 64 × 64 posts and goes straight on in the grid, 0.04° off after 15 km at 36° north.
/// Where the grid ends, nothing stands in the way; voids neither block nor have a horizon.
class HeightField {
 public:
    /// `up` (row, column) [m], NaN where void; `plan`: east and north [m] of the nine posts at the
    /// corners, the middles of the sides and the middle, row by row; between them quadratic.
    /// Rows must turn clockwise from columns seen from above (east and south). Throws InputError
    /// for less than 2 × 2 posts and a plan that is not so.
    HeightField(int columns, int rows, std::span<const float> up,
                const std::array<Eigen::Vector2d, 9>& plan);
    /// The same plan with other heights.
    HeightField with_heights(std::span<const float> up) const {
        return {columns_, rows_, up, plan_};
    }
    /// A grid of equal steps [m], first post in the north-west at the origin.
    HeightField(int columns, int rows, std::span<const float> up, double step);

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

    /// For the algorithms below.
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

/// Tangent of the horizon's elevation at each post (row, column) towards an azimuth (clockwise from
/// north): the highest of the relief, at least 0. The eye is `lift` [m] above the post.
void horizon(const HeightField& field, double azimuth_deg, std::span<float> tangent,
             double lift = 0.0);

/// Tangent of the horizon's elevation towards the sun, exact where it is within `margin` [rad] of
/// the sun's centre, else the nearest end of that interval: all that a shadow needs, and faster.
void horizon_near(const HeightField& field, const Eigen::Vector3d& direction, double margin,
                  std::span<float> tangent, double lift = 0.0);

/// The share of the sun's disc above a horizon of the given tangent, 0 to 1. The horizon is taken
/// as straight across the disc.
float disc_above(float horizon_tangent, double sun_elevation);

/// The share of the sun's disc seen from each post, (row, column); direction is a unit vector
/// towards its centre. Zero while the whole disc is below the horizontal. Voids are in no shadow.
void sun_fraction(const HeightField& field, const Eigen::Vector3d& direction,
                  std::span<float> fraction, double lift = 0.0);

/// What each post sees of the sky above the horizontal, cosine-weighted about its normal,
/// (row, column), 0 to 1:
///
///     V = 1/π ∫ [n_z cos²h / 2 + n_φ (π/2 − h − sin h cos h) / 2] dφ
///
/// with h the horizon towards φ or where the post's own plane ends, whichever is higher, and n_φ
/// the normal's component that way (Dozier & Frew 1990, eq. 7b). Error by number of azimuths, rms
/// on real relief: 8: 1e-3, 16: 4e-4, 32: 1.3e-4. Voids have 1.
void sky_view(const HeightField& field, int azimuths, std::span<float> sky_view);

}  // namespace diurna
