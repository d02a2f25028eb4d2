#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "terrain/relief/height_field.hpp"
#include "terrain/relief/march.hpp"

namespace diurna {

inline constexpr int tile_side = 64;  // posts in each direction that share one path

/// A straight path in plan: its crossings with the grid's lines and diagonals, in order, relative
/// to the post at which it starts.
struct GridWay {
    std::vector<Crossing> crossing;
    std::vector<Stretch> stretch;

    MarchWay view() const {
        return {crossing.data(), stretch.data(), static_cast<int>(stretch.size())};
    }
};

/// The paths of one azimuth: one for all posts if the plan is a regular grid; else one for each
/// tile, computed when needed, since all of them would take gigabytes on a large raster.
class GridWays {
 public:
    /// Holds a reference to the field.
    GridWays(const HeightField& field, const Eigen::Vector2d& east_north);

    /// The path of the tile that begins at a post; `room` stores it unless it is shared by all.
    const GridWay& at(int row, int column, GridWay& room) const;

 private:
    /// Columns and rows per metre of plan.
    Eigen::Vector2d towards(double column, double row) const;

    const HeightField& field_;
    Eigen::Vector2d east_north_;
    std::optional<GridWay> even_;
};

}  // namespace diurna
