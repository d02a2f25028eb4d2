#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "terrain/relief/height_field.hpp"
#include "terrain/relief/march.hpp"

namespace diurna {

inline constexpr int tile_side = 64;  // posts, each way, that share one way

/// A straight way in plan: its crossings with the grid's lines and diagonals, in order, seen from
/// whatever post it starts at.
struct GridWay {
    std::vector<Crossing> crossing;
    std::vector<Stretch> stretch;

    MarchWay view() const {
        return {crossing.data(), stretch.data(), static_cast<int>(stretch.size())};
    }
};

/// The ways of one azimuth: one for all posts where the plan is even; else one for each tile, found
/// when it is needed, since all of them at once would be gigabytes on a large raster.
class GridWays {
 public:
    /// The field is kept by reference.
    GridWays(const HeightField& field, const Eigen::Vector2d& east_north);

    /// Of the tile that begins at a post; `room` holds it if it is not for all.
    const GridWay& at(int row, int column, GridWay& room) const;

 private:
    /// Columns and rows per metre of plan.
    Eigen::Vector2d towards(double column, double row) const;

    const HeightField& field_;
    Eigen::Vector2d east_north_;
    std::optional<GridWay> even_;
};

}  // namespace diurna
