#include "terrain/relief/smooth_normal.hpp"

#include <algorithm>

namespace diurna {

Eigen::Vector3f smooth_normal(const HeightField& relief, const Eigen::Vector2d& place) {
    const Eigen::Vector2d post = relief.post(place);
    const double x = std::clamp(post.x(), 0.0, double(relief.columns() - 1));
    const double y = std::clamp(post.y(), 0.0, double(relief.rows() - 1));
    const int column = std::min(int(x), relief.columns() - 2);
    const int row = std::min(int(y), relief.rows() - 2);
    const auto right = static_cast<float>(x - column), down = static_cast<float>(y - row);
    const Eigen::Vector3f upper =
        (1.0f - right) * relief.normal(row, column) + right * relief.normal(row, column + 1);
    const Eigen::Vector3f lower = (1.0f - right) * relief.normal(row + 1, column) +
                                  right * relief.normal(row + 1, column + 1);
    return ((1.0f - down) * upper + down * lower).normalized();
}

}  // namespace diurna
