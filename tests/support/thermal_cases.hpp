#pragma once

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <vector>

#include "materials/base/units.hpp"
#include "materials/matter/soil.hpp"
#include "thermal/column/nonlinear_column.hpp"

/// Cases of reference/thermal/analytic_cases.md that tests hold and the validation table shows.

namespace manufactured {

using namespace diurna;

/// reference/thermal/analytic_cases.md, A11, for the law of conductivity the program has:
/// T = 300 + A e^(−z/L) cos ωt solves C ∂T/∂t = ∂(k ∂T/∂z)/∂z + S with k = k₀ (1 + T³/300³) and
/// S = C ∂T/∂t − k ∂²T/∂z² − dk/dT (∂T/∂z)². Above, its own flux −k ∂T/∂z comes in.
inline constexpr double omega = 2.0 * std::numbers::pi / 86400.0, amplitude = 15.0, folding = 0.1;
inline constexpr double least = 0.5, cubic = 1.0 / (300.0 * 300.0 * 300.0), capacity = 2e6;

inline double exact(double z, double t) {
    return 300.0 + amplitude * std::exp(-z / folding) * std::cos(omega * t);
}

inline double source(double z, double t) {
    const double temperature = exact(z, t), wave = temperature - 300.0;
    const double slope = -wave / folding, bend = wave / (folding * folding);
    const double change = -omega * amplitude * std::exp(-z / folding) * std::sin(omega * t);
    const double k = least * (1.0 + cubic * temperature * temperature * temperature);
    const double steeper = 3.0 * least * cubic * temperature * temperature;
    return capacity * change - k * bend - steeper * slope * slope;
}

inline double flux(double t) {
    const double temperature = exact(0.0, t);
    return least * (1.0 + cubic * temperature * temperature * temperature) * (temperature - 300.0) /
           folding;
}

/// Surface temperature over a quarter of a day, at eight instants.
inline std::vector<double> solve(int cells, int steps) {
    const double depth = 1.6, span = 21600.0;
    std::vector<Layer> layers;
    for (int i = 0; i < cells; ++i) {
        Layer layer{depth / cells, least, 2000.0, 1000.0};
        layer.law = Radiating{.cubic = cubic, .heat = {1000.0, 0.0, 0.0, 0.0, 0.0}};
        layers.push_back(layer);
    }
    const NonlinearColumn column(layers, FixedTemperature{300.0}, 300.0,
                                 {.first = 100.0, .growth = 0.1, .deepest = 1e9});
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
        const auto taken = column.advance(
            {.duration = step, .top = {&top[0], &top[1]}, .source = {&released[0], &released[1]}},
            u);
        if (!taken.solved) return {};
        if ((i + 1) % (steps / 8) == 0) result.push_back(column.temperature(0, u[0]));
    }
    return result;
}

inline double apart(const std::vector<double>& a, const std::vector<double>& b) {
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

/// Observed order when the cells are halved, and when the steps are.
inline double order_in_space() {
    std::vector<double> truth;
    for (int i = 1; i <= 8; ++i) truth.push_back(exact(0.0, 21600.0 * i / 8));
    return std::log2(apart(solve(80, 768), truth) / apart(solve(160, 768), truth));
}
inline double order_in_time() {
    const auto reference = solve(80, 2048);
    return std::log2(apart(solve(80, 16), reference) / apart(solve(80, 32), reference));
}

}  // namespace manufactured

/// B1: a day of the moon's equator in 240 steps against the converged curve.
struct LunarDay {
    double rms = 1e9, worst = 1e9;  // [K]
    std::size_t nodes = 0;
};
inline LunarDay lunar_day(const std::filesystem::path& curve) {
    using namespace diurna;
    std::ifstream in(curve);
    std::vector<double> reference;
    for (double t; in >> t;) reference.push_back(t);
    if (reference.size() != 240) return LunarDay{};
    constexpr double period = 2.55024e6, geothermal = 0.018, sigma = 5.67e-8;
    const NonlinearColumn column(lunar_regolith(0.9), FixedFlux{geothermal}, 250.0,
                                 {.period = period, .first = 0.1, .growth = 0.1, .deepest = 1e9});
    const double step = period / 240.0;
    const auto absorbed = [&](double t) {
        const double angle = 2.0 * std::numbers::pi * t / period;
        const double cosine = std::max(0.0, std::cos(angle));
        const double incidence = degrees(std::acos(cosine));
        const double albedo =
            0.12 + 0.06 * std::pow(incidence / 45.0, 3) + 0.25 * std::pow(incidence / 90.0, 8);
        return cosine > 0.0 ? 1361.0 * cosine * (1.0 - albedo) : 0.0;
    };
    std::vector<double> u(column.size());
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = column.state_of(i, 250.0);
    const auto n = static_cast<Eigen::Index>(u.size());
    std::vector<double> found;
    for (int pass = 0; pass < 8; ++pass) {
        const std::vector<double> begin = u;
        Eigen::MatrixXd map = Eigen::MatrixXd::Identity(n, n);
        found.clear();
        for (int i = 0; i < 240; ++i) {
            std::array<Boundary, 2> top;
            for (std::size_t k = 0; k < 2; ++k) {
                const double heat = absorbed((i + (k == 0 ? sdirk_gamma : 1.0)) * step);
                top[k] = [heat](double t) {
                    const double cube = 0.95 * sigma * t * t * t;
                    return BoundaryFlux{heat - cube * t, -4.0 * cube};
                };
            }
            const auto taken =
                column.advance({.duration = step, .top = {&top[0], &top[1]}}, u, &map);
            if (!taken.solved) return LunarDay{};
            found.push_back(column.temperature(0, u[0]));
        }
        Eigen::VectorXd change(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            change[i] = u[std::size_t(i)] - begin[std::size_t(i)];
        }
        if (change.cwiseAbs().maxCoeff() < 1e-6) break;
        const Eigen::VectorXd move =
            (Eigen::MatrixXd::Identity(n, n) - map).fullPivLu().solve(change);
        for (Eigen::Index i = 0; i < n; ++i) u[std::size_t(i)] = begin[std::size_t(i)] + move[i];
    }
    // The file's rows may represent the beginning or the end of a step.
    double best_rms = 1e9, best_worst = 0.0;
    for (const int shift : {0, 1}) {
        double sum = 0.0, worst = 0.0;
        for (int i = 0; i < 240; ++i) {
            const double e =
                found[std::size_t((i + 239 * shift) % 240)] - reference[std::size_t(i)];
            sum += e * e;
            worst = std::max(worst, std::abs(e));
        }
        if (std::sqrt(sum / 240.0) < best_rms) {
            best_rms = std::sqrt(sum / 240.0);
            best_worst = worst;
        }
    }
    return LunarDay{.rms = best_rms, .worst = best_worst, .nodes = column.size()};
}

/// A6: water at +5 °C freezes downward from a surface at −10 °C; the front's relative error against
/// Neumann's 2 λ √(a t) after an hour and a day, for cells of `cell` [m].
struct FreezingFront {
    double hour = 1e9, day = 1e9, closure = 1e9;
};
inline FreezingFront freezing_front(double cell) {
    using namespace diurna;
    constexpr double latent = 3.06e8;
    std::vector<Layer> layers;
    Layer water{cell, 0.57, 1000.0, 4190.0};
    // Ice at the water's density: 1.93e6 J/m³K, and 3.06e8 J/m³ of latent heat.
    water.law = Freezing{
        .water = latent / 3.337e5, .frozen_conductivity = 2.22, .frozen_heat_capacity = 1930.0};
    for (int i = 0; i < int(std::lround(0.6 / cell)); ++i) layers.push_back(water);
    const NonlinearColumn column(layers, FixedFlux{0.0}, 273.15,
                                 {.first = 10.0, .growth = 0.1, .deepest = 1e9});
    std::vector<double> u(column.size(), 6.0);  // melted, and 5 K above
    // Heat above that of ice at 0 °C, and of melting alone [J m⁻²].
    const auto total_heat = [&] {
        double sum = 0.0;
        for (std::size_t i = 0; i < u.size(); ++i) sum += column.gain(i, 0.0, u[i]);
        return sum;
    };
    const auto molten = [&] {
        double sum = 0.0;
        for (std::size_t i = 0; i < u.size(); ++i) {
            sum += column.gain(i, 0.0, std::clamp(u[i], 0.0, 1.0));
        }
        return sum;
    };
    const double whole = molten(), before = total_heat();
    const auto error = [&](double depth) {
        return std::abs((whole - molten()) / latent / depth - 1.0);
    };
    const Boundary held = [](double t) { return BoundaryFlux{1e5 * (263.15 - t), -1e5}; };
    double time = 0.0, through = 0.0;
    FreezingFront front;
    while (time < 86400.0 - 1e-6) {
        const double step = std::min(time < 600.0 ? 5.0 : 60.0, 86400.0 - time);
        const auto taken = column.advance({.duration = step, .top = {&held, &held}}, u);
        if (!taken.solved) return {};
        through += taken.heat_in;
        time += step;
        if (std::abs(time - 3600.0) < 1e-6) front.hour = error(0.0213117866);
    }
    front.day = error(0.104406005);
    front.closure = std::abs((total_heat() - before) / through - 1.0);
    return front;
}
