#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <vector>

namespace diurna {

/// Converts fractional (column, row) of one raster to those of another, within a rectangle of the
/// first: Chebyshev polynomials of the fourth degree in each direction through 25 places
/// transformed by PROJ. Between maps of one datum 0.1 mm over 100 km; where PROJ shifts datums by a
/// grid file, limited by its smoothness, a few centimetres.
struct LatticeMap {
    static constexpr std::size_t nodes = 5;  // along either side

    Eigen::Vector2d low{0.0, 0.0}, high{1.0, 1.0};
    std::array<Eigen::Vector2d, nodes * nodes> coefficient{};

    /// Also a little outside the rectangle.
    Eigen::Vector2d operator()(const Eigen::Vector2d& place) const;
};

/// `bring` converts places of the first raster to the same number of places of the second.
LatticeMap lattice_map(
    const Eigen::Vector2d& low, const Eigen::Vector2d& high,
    const std::function<std::vector<Eigen::Vector2d>(std::span<const Eigen::Vector2d>)>& bring);

}  // namespace diurna
