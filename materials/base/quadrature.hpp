#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

namespace diurna {

/// ∫ f(x) dx ≈ Σ weight f(node).
struct Quadrature {
    std::vector<double> node, weight;
    std::size_t size() const { return node.size(); }
};

/// Gauss and Legendre's rule between two ends: exact for polynomials of degree 2 points − 1. Nodes
/// ascend; they are the roots of Legendre's polynomial by Newton from Chebyshev's guesses, to 1e-15
/// of the interval (tests/materials/quadrature_test.cpp).
///
/// points  1 to some hundred
inline Quadrature gauss_legendre(int points, double from = -1.0, double to = 1.0) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    const auto size = static_cast<std::size_t>(points);
    Quadrature rule{std::vector<double>(size), std::vector<double>(size)};
    for (std::size_t i = 0; i < size; ++i) {
        double x = -std::cos(std::numbers::pi * (double(i) + 0.75) / (points + 0.5));
        double slope = 1.0;
        for (int iteration = 0; iteration < 20; ++iteration) {
            double p = x, before = 1.0;
            for (int k = 2; k <= points; ++k) {
                before = std::exchange(p, ((2 * k - 1) * x * p - (k - 1) * before) / k);
            }
            slope = points * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
            if (std::abs(p / slope) < 1e-16) break;
        }
        if (points == 1) x = 0.0;
        rule.node[i] = middle + half * x;
        rule.weight[i] = half * (points == 1 ? 2.0 : 2.0 / ((1.0 - x * x) * slope * slope));
    }
    return rule;
}

}  // namespace diurna
