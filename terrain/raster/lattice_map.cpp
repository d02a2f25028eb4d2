#include "terrain/raster/lattice_map.hpp"

#include <cassert>
#include <cmath>
#include <numbers>

namespace diurna {

namespace {

constexpr std::size_t n = LatticeMap::nodes;

double node(std::size_t k) {
    return std::cos(std::numbers::pi * (double(k) + 0.5) / double(n));  // of T_n
}

/// T_0 to T_4 at x, −1 to 1.
std::array<double, n> chebyshev(double x) {
    std::array<double, n> value{1.0, x};
    for (std::size_t k = 2; k < n; ++k) value[k] = 2.0 * x * value[k - 1] - value[k - 2];
    return value;
}

}  // namespace

Eigen::Vector2d LatticeMap::operator()(const Eigen::Vector2d& place) const {
    const Eigen::Array2d at =
        2.0 * (place - low).array() / (high - low).array() - Eigen::Array2d::Ones();
    const auto across = chebyshev(at.x()), down = chebyshev(at.y());
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t j = 0; j < n; ++j) {
        Eigen::Vector2d row = Eigen::Vector2d::Zero();
        for (std::size_t i = 0; i < n; ++i) row += across[i] * coefficient[n * j + i];
        sum += down[j] * row;
    }
    return sum;
}

LatticeMap lattice_map(
    const Eigen::Vector2d& low, const Eigen::Vector2d& high,
    const std::function<std::vector<Eigen::Vector2d>(std::span<const Eigen::Vector2d>)>& bring) {
    std::vector<Eigen::Vector2d> places;
    for (std::size_t j = 0; j < n; ++j) {
        for (std::size_t i = 0; i < n; ++i) {
            const Eigen::Array2d at(node(i), node(j));
            places.emplace_back(low.array() + 0.5 * (at + 1.0) * (high - low).array());
        }
    }
    const std::vector<Eigen::Vector2d> there = bring(places);
    assert(there.size() == places.size());
    LatticeMap map{.low = low, .high = high};
    map.coefficient.fill(Eigen::Vector2d::Zero());
    // The polynomials are orthogonal over the nodes: Σ T_a T_b = 0, n for a = b = 0, else n / 2.
    for (std::size_t k = 0; k < places.size(); ++k) {
        const auto across = chebyshev(node(k % n)), down = chebyshev(node(k / n));
        for (std::size_t b = 0; b < n; ++b) {
            for (std::size_t a = 0; a < n; ++a) {
                const double share = (a == 0 ? 1.0 : 2.0) * (b == 0 ? 1.0 : 2.0) / double(n * n);
                map.coefficient[n * b + a] += share * across[a] * down[b] * there[k];
            }
        }
    }
    return map;
}

}  // namespace diurna
