#include "terrain/raster/dem_voids.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "terrain/raster/grid.hpp"

namespace diurna {

namespace {

/// Bilinear between the centres of the coarse cells.
float interpolated(const Grid& coarse, int fine_row, int fine_column) {
    const double y = std::clamp(0.5 * fine_row - 0.25, 0.0, coarse.rows - 1.0);
    const double x = std::clamp(0.5 * fine_column - 0.25, 0.0, coarse.columns - 1.0);
    const int r0 = static_cast<int>(y), c0 = static_cast<int>(x);
    const int r1 = std::min(r0 + 1, coarse.rows - 1), c1 = std::min(c0 + 1, coarse.columns - 1);
    const double v = y - r0, u = x - c0;
    return static_cast<float>(
        bilinear(coarse.at(r0, c0), coarse.at(r0, c1), coarse.at(r1, c0), coarse.at(r1, c1), u, v));
}

/// Each void takes the value of the finest grid of averages over 2 × 2, 4 × 4 ... cells that knows
/// one, interpolated between that grid's centres: continuous at the void's border to about one
/// post, smooth within. At least one value is valid.
void fill_voids(Grid& grid) {
    const auto is_void = [](float h) { return std::isnan(h); };
    if (std::none_of(grid.value.begin(), grid.value.end(), is_void)) return;
    Grid coarse = halved(grid);
    fill_voids(coarse);
    for (int row = 0; row < grid.rows; ++row) {
        for (int column = 0; column < grid.columns; ++column) {
            float& height = grid.at(row, column);
            if (std::isnan(height)) height = interpolated(coarse, row, column);
        }
    }
}

}  // namespace

void apply_void_policy(Dem& dem, VoidPolicy policy) {
    dem.voids = static_cast<std::size_t>(
        std::count_if(dem.height.begin(), dem.height.end(), [](float h) { return std::isnan(h); }));
    if (dem.voids == dem.height.size()) {
        throw InputError(dem.source, "has no elevation: every post is void");
    }
    if (dem.voids > 0) {
        dem.is_void.resize(dem.height.size());
        std::transform(dem.height.begin(), dem.height.end(), dem.is_void.begin(),
                       [](float h) { return std::uint8_t{std::isnan(h)}; });
    }
    if (dem.voids == 0 || policy == VoidPolicy::leave) return;
    if (policy == VoidPolicy::refuse) {
        const double percent = 100.0 * double(dem.voids) / double(dem.height.size());
        throw InputError(
            dem.source,
            fmt::format("no elevation at {} ({:.2g} %)", number_of(dem.voids, "post"), percent),
            "voids = \"fill\" interpolates them");
    }
    Grid grid{dem.columns, dem.rows, std::move(dem.height)};
    fill_voids(grid);
    dem.height = std::move(grid.value);
}

}  // namespace diurna
