#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "terrain/ground/triangulate.hpp"

namespace diurna {

Tin full_grid(const Dem& dem) {
    Tin tin;
    const auto columns = static_cast<std::size_t>(dem.columns);
    constexpr auto none = std::uint32_t(-1);
    std::vector<std::uint32_t> vertex(dem.height.size(), none);
    tin.post.reserve(dem.height.size());
    tin.triangle.reserve(2 * dem.height.size());
    for (int row = 0; row < dem.rows; ++row) {
        for (int column = 0; column < dem.columns; ++column) {
            if (std::isnan(dem.at(row, column))) continue;
            vertex[std::size_t(row) * columns + std::size_t(column)] =
                static_cast<std::uint32_t>(tin.post.size());
            tin.post.push_back({column, row});
        }
    }
    for (int row = 0; row + 1 < dem.rows; ++row) {
        for (int column = 0; column + 1 < dem.columns; ++column) {
            const std::uint32_t* above = &vertex[std::size_t(row) * columns + std::size_t(column)];
            const std::uint32_t a = above[0], b = above[1], c = above[columns],
                                d = above[columns + 1];
            const auto add = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
                if (i != none && j != none && k != none) tin.triangle.push_back({i, j, k});
            };
            if (a == none || d == none) {  // the one triangle that is left has the other diagonal
                add(a, c, b);
                add(b, c, d);
            } else {
                add(a, d, b);
                add(a, c, d);
            }
        }
    }
    return tin;
}

Tin affordable_network(const Dem& dem, double tolerance) {
    // Measured with `diurna mesh`: the program and its libraries, what is held and checked for each
    // post of the raster and of a finished grid.
    constexpr double program = 70e6, a_post = 10.0, a_grid_post = 65.0;
    const auto posts = static_cast<double>(dem.height.size());
    const double room = 10.0 * 2.0 * posts + 200e6 - program - a_post * posts;
    if (auto network = triangulate_within(dem, tolerance, room)) return std::move(*network);
    const double valid = posts - static_cast<double>(dem.voids);
    if (valid * a_grid_post <= room) return full_grid(dem);
    throw InputError(dem.source,
                     fmt::format("a mesh to {:g} m does not fit into {:.0f} MB", tolerance,
                                 1e-6 * (20.0 * posts + 200e6)),
                     "a coarser tolerance, or a part of the raster");
}

}  // namespace diurna
