#include "terrain/relief/grid_ways.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace diurna {

namespace {

/// Where a way crosses a line: between two posts seen from its own.
struct Found {
    double distance;  // [m]
    int column, row, next_column, next_row;
    double weight;  // of the next
};

/// All crossings within `reach` metres, in order. `towards`: columns and rows per metre of plan.
std::vector<Found> crossings(const Eigen::Vector2d& towards, double reach) {
    const double u = towards.x(), v = towards.y();
    std::vector<Found> found;
    const auto whole = [](double x) { return static_cast<int>(std::floor(x)); };
    const auto lines = [&](double speed, const auto& add) {
        if (std::abs(speed) * reach < 1.0) return;
        for (int k = 1;; ++k) {
            const double distance = k / std::abs(speed);
            if (distance > reach) return;
            add(distance, speed > 0.0 ? k : -k);
        }
    };
    lines(v, [&](double distance, int row) {
        const double x = u * distance;
        found.push_back({distance, whole(x), row, whole(x) + 1, row, x - std::floor(x)});
    });
    const std::size_t rows = found.size();
    lines(u, [&](double distance, int column) {
        const double y = v * distance;
        found.push_back({distance, column, whole(y), column, whole(y) + 1, y - std::floor(y)});
    });
    const std::size_t columns = found.size();
    lines(u - v, [&](double distance, int diagonal) {
        const double y = v * distance;
        const int row = whole(y), column = row + diagonal;
        found.push_back({distance, column, row, column + 1, row + 1, y - row});
    });
    // Each family of lines is in order already.
    const auto nearer = [](const Found& a, const Found& b) { return a.distance < b.distance; };
    const auto at = [&](std::size_t k) { return found.begin() + static_cast<std::ptrdiff_t>(k); };
    std::inplace_merge(found.begin(), at(rows), at(columns), nearer);
    std::inplace_merge(found.begin(), at(columns), found.end(), nearer);
    return found;
}

/// Starts at a post and goes on for `reach` metres.
GridWay way(const HeightField& field, const Eigen::Vector2d& towards, double reach) {
    const std::vector<Found> found = crossings(towards, reach);
    const double per_step = 1.0 / towards.lpNorm<Eigen::Infinity>();  // [m] per grid line
    GridWay result;
    result.crossing.reserve(found.size());
    const auto pitch = static_cast<int>(field.pitch());
    std::size_t i = 0;
    for (int k = 0; i < found.size(); ++k) {
        const double near = k * march_steps * per_step, far = near + march_steps * per_step;
        Stretch stretch{.begin = static_cast<std::int32_t>(i),
                        .end = 0,
                        .column = 1 << 30,
                        .row = 1 << 30,
                        .inverse_near = k == 0 ? 1e30f : static_cast<float>(1.0 / near)};
        for (; i < found.size() && found[i].distance <= far * (1.0 + 1e-12); ++i) {
            const Found& f = found[i];
            result.crossing.push_back({f.row * pitch + f.column, f.next_row * pitch + f.next_column,
                                       static_cast<float>(f.weight),
                                       static_cast<float>(1.0 / f.distance)});
            stretch.column = std::min(stretch.column, f.column);
            stretch.row = std::min(stretch.row, f.row);
        }
        stretch.end = static_cast<std::int32_t>(i);
        result.stretch.push_back(stretch);
    }
    return result;
}

}  // namespace

GridWays::GridWays(const HeightField& field, const Eigen::Vector2d& east_north)
    : field_(field), east_north_(east_north.normalized()) {
    const double right = field.columns() - 1, bottom = field.rows() - 1;
    const Eigen::Vector2d first = towards(0.0, 0.0);
    const double bent =
        std::max({(towards(right, 0.0) - first).norm(), (towards(0.0, bottom) - first).norm(),
                  (towards(right, bottom) - first).norm()});
    if (bent >= 1e-6 * first.norm()) return;
    even_ = way(field, first,
                (std::max(right, bottom) + march_steps) / first.lpNorm<Eigen::Infinity>());
}

const GridWay& GridWays::at(int row, int column, GridWay& room) const {
    if (even_) return *even_;
    const double right = field_.columns() - 1, bottom = field_.rows() - 1;
    const Eigen::Vector2d to =
        towards(std::min(right, column + 0.5 * tile_side), std::min(bottom, row + 0.5 * tile_side));
    // To where the last of its posts leaves the grid, and a stretch more.
    const auto leaves = [](double speed, double first, double last) {
        if (speed == 0.0) return std::numeric_limits<double>::infinity();
        return speed > 0.0 ? (last - first) / speed : (first + tile_side) / -speed;
    };
    const double inside = std::min(leaves(to.x(), column, right), leaves(to.y(), row, bottom));
    room = way(field_, to, inside + 2.0 * march_steps / to.lpNorm<Eigen::Infinity>());
    return room;
}

Eigen::Vector2d GridWays::towards(double column, double row) const {
    return field_.jacobian({column, row}).inverse() * east_north_;
}

}  // namespace diurna
