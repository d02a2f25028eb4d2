#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "thermal/nonlinear_column.hpp"

using namespace diurna;

namespace {

/// reference/thermal/analytic_cases.md, A11, for the law of conductivity the program has:
/// T = 300 + A e^(−z/L) cos ωt solves C ∂T/∂t = ∂(k ∂T/∂z)/∂z + S with k = k₀ (1 + T³/300³) and
/// S = C ∂T/∂t − k ∂²T/∂z² − dk/dT (∂T/∂z)². Above, its own flux −k ∂T/∂z comes in.
constexpr double omega = 2.0 * std::numbers::pi / 86400.0, amplitude = 15.0, folding = 0.1;
constexpr double least = 0.5, cubic = 1.0 / (300.0 * 300.0 * 300.0), capacity = 2e6;

double exact(double z, double t) {
    return 300.0 + amplitude * std::exp(-z / folding) * std::cos(omega * t);
}

double source(double z, double t) {
    const double temperature = exact(z, t), wave = temperature - 300.0;
    const double slope = -wave / folding, bend = wave / (folding * folding);
    const double change = -omega * amplitude * std::exp(-z / folding) * std::sin(omega * t);
    const double k = least * (1.0 + cubic * temperature * temperature * temperature);
    const double steeper = 3.0 * least * cubic * temperature * temperature;
    return capacity * change - k * bend - steeper * slope * slope;
}

double flux(double t) {
    const double temperature = exact(0.0, t);
    return least * (1.0 + cubic * temperature * temperature * temperature) * (temperature - 300.0) /
           folding;
}

/// Surface temperature over a quarter of a day, at eight instants.
std::vector<double> solve(int cells, int steps) {
    const double depth = 1.6, span = 21600.0;
    std::vector<Layer> layers;
    for (int i = 0; i < cells; ++i) {
        Layer layer{depth / cells, least, 2000.0, 1000.0};
        layer.law = Radiating{.cubic = cubic, .heat = {1000.0, 0.0, 0.0, 0.0, 0.0}};
        layers.push_back(layer);
    }
    const NonlinearColumn column(layers, FixedTemperature{300.0}, 300.0,
                                 {.first = 100.0, .growth = 0.1, .deepest = 1e9});
    REQUIRE(column.size() == std::size_t(cells));
    const double width = depth / cells, step = span / steps;
    std::vector<double> u(column.size()), result;
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = column.state_of(i, exact(column.depth(i), 0));
    std::array<std::vector<double>, 2> released{u, u};
    for (int i = 0; i < steps; ++i) {
        std::array<Boundary, 2> top;
        for (std::size_t k = 0; k < 2; ++k) {
            const double t = (i + (k == 0 ? sdirk_gamma : 1.0)) * step, in = flux(t);
            top[k] = [in](double) { return BoundaryFlux{in, 0.0}; };
            for (std::size_t node = 0; node < u.size(); ++node) {
                released[k][node] = (node == 0 ? 0.5 : 1.0) * width * source(column.depth(node), t);
            }
        }
        REQUIRE(
            column
                .advance(step, false, {&top[0], &top[1]}, {nullptr, nullptr}, u, nullptr, &released)
                .solved);
        if ((i + 1) % (steps / 8) == 0) result.push_back(column.temperature(0, u[0]));
    }
    return result;
}

double apart(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

}  // namespace

TEST_CASE("halving the cells quarters the error", "[thermal][manufactured][a11]") {
    std::vector<double> truth;
    for (int i = 1; i <= 8; ++i) truth.push_back(exact(0.0, 21600.0 * i / 8));
    const double coarse = apart(solve(80, 768), truth), fine = apart(solve(160, 768), truth);
    const double order = std::log2(coarse / fine);
    WARN(fmt::format("A11 in space: {:.2e}, {:.2e} K, order {:.3f}", coarse, fine, order));
    CHECK(order >= 1.8);
    CHECK(fine < 0.05);
}

TEST_CASE("halving the steps quarters the error", "[thermal][manufactured][a11]") {
    const auto reference = solve(80, 2048);
    const double coarse = apart(solve(80, 16), reference), fine = apart(solve(80, 32), reference);
    const double order = std::log2(coarse / fine);
    WARN(fmt::format("A11 in time: {:.2e}, {:.2e} K, order {:.3f}", coarse, fine, order));
    CHECK(order >= 1.8);
}
