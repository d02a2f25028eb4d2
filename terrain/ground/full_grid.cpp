#include "terrain/ground/full_grid.hpp"

#include <cmath>

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

}  // namespace diurna
