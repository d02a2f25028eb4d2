#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <span>
#include <vector>

namespace diurna {

/// From the fractional (column, row) of one raster to those of another, within a rectangle of the
/// first: Chebyshev polynomials of the fourth degree in either direction through 25 places that
/// PROJ has brought over. Between maps of one datum 0.1 mm over 100 km; where PROJ shifts datums by
/// a grid file, as good as that is smooth, a few centimetres.
struct LatticeMap {
    static constexpr std::size_t nodes = 5;  // along either side

    Eigen::Vector2d low{0.0, 0.0}, high{1.0, 1.0};
    std::array<Eigen::Vector2d, nodes * nodes> coefficient{};

    /// Also a little outside the rectangle.
    Eigen::Vector2d operator()(const Eigen::Vector2d& place) const;
};

/// `bring` has places of the first raster and answers with those of the second, as many.
LatticeMap lattice_map(
    const Eigen::Vector2d& low, const Eigen::Vector2d& high,
    const std::function<std::vector<Eigen::Vector2d>(std::span<const Eigen::Vector2d>)>& bring);

}  // namespace diurna
