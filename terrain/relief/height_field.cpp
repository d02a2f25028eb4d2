#include "terrain/relief/height_field.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "materials/base/error.hpp"
#include "terrain/raster/dem_places.hpp"

namespace diurna {

namespace {

// How far the march reads beyond the grid: a block that just touches it, and a stretch.
constexpr int border_columns = march_lanes + march_steps + 8;
constexpr int border_rows = march_steps + 8;
// Tiles that a window covers, and that lie before the first.
constexpr int window_wide = (tile_columns - 1 + march_lanes + march_steps + 2) / tile_columns + 1;
constexpr int window_high = (tile_rows - 1 + march_steps + 3) / tile_rows + 1;
constexpr int tiles_before = 8;

/// Quadratic weights of the three nodes 0, ½, 1, and their derivatives.
std::array<double, 3> quadratic(double t) {
    return {(1.0 - t) * (1.0 - 2.0 * t), 4.0 * t * (1.0 - t), t * (2.0 * t - 1.0)};
}
std::array<double, 3> quadratic_slope(double t) {
    return {4.0 * t - 3.0, 4.0 - 8.0 * t, 4.0 * t - 1.0};
}

Eigen::Vector2d blend(const std::array<Eigen::Vector2d, 9>& plan, const std::array<double, 3>& x,
                      const std::array<double, 3>& y) {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) sum += x[i] * y[j] * plan[std::size_t(3 * j + i)];
    }
    return sum;
}

}  // namespace

HeightField::HeightField(int columns, int rows, std::span<const float> up,
                         const std::array<Eigen::Vector2d, 9>& plan)
    : columns_(columns), rows_(rows), pitch_(columns + 2 * border_columns), plan_(plan) {
    if (columns < 2 || rows < 2) {
        throw InputError("height field",
                         fmt::format("has {} x {} posts, expected at least 2 x 2", columns, rows));
    }
    assert(up.size() == size());
    for (const double y : {0.0, 0.5, 1.0}) {
        for (const double x : {0.0, 0.5, 1.0}) {
            if (!(jacobian({x * (columns - 1), y * (rows - 1)}).determinant() < 0.0)) {
                throw InputError("height field", "its rows are not clockwise from its columns");
            }
        }
    }
    up_.assign(std::size_t(pitch_) * std::size_t(rows + 2 * border_rows), no_ground);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const float h = up[std::size_t(row) * columns + column];
            if (!std::isnan(h)) up_[offset(row, column)] = h;
        }
    }
    fill_windows();
}

std::size_t HeightField::offset(int row, int column) const {
    return std::size_t(row + border_rows) * std::size_t(pitch_) +
           std::size_t(column + border_columns);
}

void HeightField::fill_windows() {
    window_columns_ = (columns_ + tile_columns - 1) / tile_columns + 2 * tiles_before;
    window_rows_ = (rows_ + tile_rows - 1) / tile_rows + 2 * tiles_before;
    std::vector<float> tile(std::size_t(window_columns_) * std::size_t(window_rows_), no_ground);
    for (int row = 0; row < rows_; ++row) {
        for (int column = 0; column < columns_; ++column) {
            float& high = tile[std::size_t(row / tile_rows + tiles_before) * window_columns_ +
                               std::size_t(column / tile_columns + tiles_before)];
            high = std::max(high, up(row, column));
            highest_ = std::max(highest_, high);
        }
    }
    // First along the rows, then down the columns.
    std::vector<float> wide(tile.size(), no_ground);
    window_.assign(tile.size(), no_ground);
    for (int y = 0; y < window_rows_; ++y) {
        for (int x = 0; x < window_columns_; ++x) {
            for (int k = 0; k < window_wide && x + k < window_columns_; ++k) {
                float& high = wide[std::size_t(y) * window_columns_ + x];
                high = std::max(high, tile[std::size_t(y) * window_columns_ + x + k]);
            }
        }
    }
    for (int y = 0; y < window_rows_; ++y) {
        for (int k = 0; k < window_high && y + k < window_rows_; ++k) {
            for (int x = 0; x < window_columns_; ++x) {
                float& high = window_[std::size_t(y) * window_columns_ + x];
                high = std::max(high, wide[std::size_t(y + k) * window_columns_ + x]);
            }
        }
    }
}

MarchField HeightField::march_field() const {
    return {
        .up = up_.data() + offset(0, 0),
        .pitch = pitch_,
        .columns = columns_,
        .rows = rows_,
        .window = window_.data() + std::ptrdiff_t(tiles_before) * window_columns_ + tiles_before,
        .window_pitch = window_columns_,
        .highest = highest_};
}

Eigen::Vector2d HeightField::place(const Eigen::Vector2d& post) const {
    return blend(plan_, quadratic(post.x() / (columns_ - 1)), quadratic(post.y() / (rows_ - 1)));
}

Eigen::Matrix2d HeightField::jacobian(const Eigen::Vector2d& post) const {
    const double x = post.x() / (columns_ - 1), y = post.y() / (rows_ - 1);
    Eigen::Matrix2d j;
    j.col(0) = blend(plan_, quadratic_slope(x), quadratic(y)) / (columns_ - 1);
    j.col(1) = blend(plan_, quadratic(x), quadratic_slope(y)) / (rows_ - 1);
    return j;
}

Eigen::Vector2d HeightField::post(const Eigen::Vector2d& east_north) const {
    Eigen::Vector2d p(0.5 * (columns_ - 1), 0.5 * (rows_ - 1));
    for (int pass = 0; pass < 4; ++pass) {  // Newton; the plan is nearly even
        p -= jacobian(p).inverse() * (place(p) - east_north);
    }
    return p;
}

Eigen::Vector3f HeightField::normal(int row, int column) const {
    const Eigen::Matrix2d j = jacobian({double(column), double(row)});
    const double here = up(row, column);
    if (here == no_ground) return Eigen::Vector3f::UnitZ();
    // The six triangles round a post, by its neighbours in turn; rows run south.
    constexpr int ring[7][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, 0}};
    const auto edge = [&](const int(&step)[2]) -> Eigen::Vector3d {
        const Eigen::Vector2d plan = j * Eigen::Vector2d(step[0], step[1]);
        const double height = up_[offset(row + step[1], column + step[0])];
        return {plan.x(), plan.y(), height - here};
    };
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int k = 0; k < 6; ++k) {
        const Eigen::Vector3d a = edge(ring[k]), b = edge(ring[k + 1]);
        if (a.z() > 0.5 * no_ground && b.z() > 0.5 * no_ground) sum += b.cross(a);
    }
    return sum.squaredNorm() > 0.0 ? Eigen::Vector3f(sum.normalized().cast<float>())
                                   : Eigen::Vector3f::UnitZ();
}

HeightField height_field(const Dem& dem, const Site& site) {
    std::vector<float> up(dem.height.size());
    std::vector<Eigen::Vector2d> place(static_cast<std::size_t>(dem.columns));
    double lowest = 1e9, highest = -1e9;
    for (int row = 0; row < dem.rows; ++row) {
        const float* height = dem.height.data() + std::size_t(row) * dem.columns;
        for (int column = 0; column < dem.columns; ++column) {
            place[std::size_t(column)] = {double(column), double(row)};
            if (std::isnan(height[column])) continue;
            lowest = std::min(lowest, double{height[column]});
            highest = std::max(highest, double{height[column]});
        }
        const auto local = local_vertices(dem, site, place, {height, std::size_t(dem.columns)});
        for (int column = 0; column < dem.columns; ++column) {
            up[std::size_t(row) * dem.columns + column] =
                std::isnan(height[column]) ? height[column]
                                           : static_cast<float>(local[std::size_t(column)].z());
        }
    }
    std::vector<Eigen::Vector2d> nodes;
    for (int k = 0; k < 9; ++k) {
        nodes.emplace_back((dem.columns - 1) * (k % 3) / 2.0, (dem.rows - 1) * (k / 3) / 2.0);
    }
    const std::vector<float> level(9, static_cast<float>(0.5 * (lowest + highest)));
    const auto local = local_vertices(dem, site, nodes, level);
    std::array<Eigen::Vector2d, 9> plan;
    for (std::size_t k = 0; k < 9; ++k) plan[k] = local[k].head<2>();
    return {dem.columns, dem.rows, up, plan};
}

}  // namespace diurna
