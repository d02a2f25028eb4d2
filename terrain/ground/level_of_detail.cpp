#include "terrain/ground/level_of_detail.hpp"

#include <algorithm>
#include <cmath>

#include "terrain/raster/dem_places.hpp"

namespace diurna {

std::vector<float> level_of_detail(const Dem& dem, std::span<const Viewpoint> viewpoints,
                                   double tolerance, double coarsest) {
    const Eigen::Vector2d spacing = post_spacing(dem);
    std::vector<float> slack(dem.height.size());
    for (int row = 0; row < dem.rows; ++row) {
        for (int column = 0; column < dem.columns; ++column) {
            double seen = coarsest;
            for (const Viewpoint& v : viewpoints) {
                const Eigen::Vector2d across =
                    (Eigen::Vector2d(column, row) - v.place).cwiseProduct(spacing);
                seen = std::min(seen, v.angle * std::hypot(across.norm(), v.height));
            }
            slack[std::size_t(row) * dem.columns + column] =
                static_cast<float>(std::max(1.0, seen / tolerance));
        }
    }
    return slack;
}

}  // namespace diurna
