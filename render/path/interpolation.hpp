#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace diurna {

// Lagrange interpolation between nodes at 0, 1, 2 ..., and its error.

/// Weight of node j of `count` for the place y: Π (y − k) / (j − k).
inline double lagrange_weight(double y, std::size_t j, std::size_t count) {
    double weight = 1.0;
    for (std::size_t k = 0; k < count; ++k) {
        if (k != j) weight *= (y - double(k)) / (double(j) - double(k));
    }
    return weight;
}

/// The same of two, three or five nodes, multiplied out, for loops over pixels.
inline constexpr std::size_t most_few = 5;
inline std::array<float, most_few> weights_of_few(float y, std::size_t count) {
    if (count == 2) return {1.0f - y, y};
    const float a = y - 1.0f, b = y - 2.0f;
    if (count == 3) return {0.5f * a * b, -y * b, 0.5f * y * a};
    const float c = y - 3.0f, d = y - 4.0f;
    return {a * b * c * d / 24.0f, y * b * c * d / -6.0f, y * a * c * d / 4.0f,
            y * a * b * d / -6.0f, y * a * b * c / 24.0f};
}

/// The same as products of the distances to the nodes before and after each: with other rounding,
/// used in pictures with panes, nets, plumes or mirrors.
std::array<float, most_few> product_weights_of_few(float y, std::size_t count);

/// Weights of the four nodes start .. start + 3 of a uniform grid for a position x nodes after its
/// start: cubic.
struct Stencil {
    std::size_t start = 0;
    std::array<float, 4> weight{};
};
Stencil stencil(double x, std::size_t nodes);

/// Interpolates the nodes' values at x: cubic.
double interpolated(std::span<const double> value, double x);

/// Matrix (fine node, coarse node) that interpolates on a uniform grid: cubic Lagrange, or a
/// polynomial through all nodes if there are fewer than six.
Eigen::MatrixXd interpolation_matrix(std::size_t coarse, std::size_t fine);

/// Five values interpolated between `count` of them, 2, 3 or 5 at even steps.
std::array<double, most_few> from_fewer(const std::array<double, most_few>& value,
                                        std::size_t count);

/// The largest error of a cubic in the middles between nodes, over scale(correct value).
///
/// - value: value(k) of node k
/// - middle: middle(k) the correct value half-way between the nodes k and k + 1
template <class Value, class Middle, class Scale>
double worst_between(std::size_t count, const Value& value, const Middle& middle,
                     const Scale& scale) {
    double worst = 0.0;
    for (std::size_t i = 0; i + 1 < count; ++i) {
        const Stencil s = stencil(double(i) + 0.5, count);
        double sum = 0.0;
        for (std::size_t k = 0; k < 4; ++k) sum += double{s.weight[k]} * value(s.start + k);
        const double right = middle(i);
        worst = std::max(worst, std::abs(sum - right) / scale(right));
    }
    return worst;
}

}  // namespace diurna
