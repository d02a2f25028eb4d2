#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <vector>

#include "thermal/network/network_step.hpp"

/// Sheets of triangles as networks of heat, and what closed forms say of them.
namespace diurna::testing {

inline constexpr double pi = std::numbers::pi;
inline constexpr Layer aluminium{0.002, 200.0, 2700.0, 900.0};

/// A sheet in its plane, cut into triangles.
struct Sheet {
    HeatNetwork network;
    std::vector<Eigen::Vector2d> centre;
    std::vector<std::array<Eigen::Vector2d, 3>> middle;  // of the sides

    /// The mean over a facet of what is given at points, exact to second order.
    template <class Of>
    double mean(std::size_t f, const Of& of) const {
        return (of(middle[f][0]) + of(middle[f][1]) + of(middle[f][2])) / 3.0;
    }
};

/// across × up rectangles of two triangles each; inner corners moved by up to `uneven` of a cell.
inline Sheet sheet(double width, double height, int across, int up, const NetworkColumn& column,
                   double uneven = 0.0) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-uneven, uneven);
    std::vector<Eigen::Vector2d> corner;
    for (int j = 0; j <= up; ++j) {
        for (int i = 0; i <= across; ++i) {
            const double x = i > 0 && i < across ? i + any(random) : i;
            const double y = j > 0 && j < up ? j + any(random) : j;
            corner.emplace_back(x * width / across, y * height / up);
        }
    }
    Sheet made;
    made.network.column = {column};
    std::map<std::pair<int, int>, std::uint32_t> edge;
    const auto add = [&](std::array<int, 3> v) {
        NetworkFacet facet;
        std::array<double, 3> side{};
        std::array<Eigen::Vector2d, 3> middle;
        for (int s = 0; s < 3; ++s) {
            const int a = v[(s + 1) % 3], b = v[(s + 2) % 3];
            middle[s] = 0.5 * (corner[a] + corner[b]);
            side[s] = (corner[a] - corner[b]).norm();
            facet.edge[0][s] =
                edge.try_emplace(std::minmax(a, b), std::uint32_t(edge.size())).first->second;
        }
        const Eigen::Vector2d p = corner[v[1]] - corner[v[0]], q = corner[v[2]] - corner[v[0]];
        facet.area = 0.5 * std::abs(p.x() * q.y() - p.y() * q.x());
        facet.sideways = sideways_flow(side, facet.area);
        made.network.facet.push_back(facet);
        made.middle.push_back(middle);
        made.centre.push_back((corner[v[0]] + corner[v[1]] + corner[v[2]]) / 3.0);
    };
    for (int j = 0; j < up; ++j) {
        for (int i = 0; i < across; ++i) {
            const int a = j * (across + 1) + i, c = a + across + 1;
            add({a, a + 1, c + 1});
            add({a, c + 1, c});
        }
    }
    made.network.edges = std::uint32_t(edge.size());
    return made;
}

/// Films to air on the outer ends, and on the inner ones.
inline NetworkForcing in_air(double air, double outer_film, double inner_film) {
    return {.loads = {},
            .faces = [=](double, const std::vector<double>& outer, const std::vector<double>& inner,
                         FaceFluxes& out) {
                for (std::size_t f = 0; f < outer.size(); ++f) {
                    out.outer[f] = outer_film * (air - outer[f]);
                    out.outer_slope[f] = -outer_film;
                    out.inner[f] = inner_film * (air - inner[f]);
                    out.inner_slope[f] = -inner_film;
                }
            }};
}

/// The largest excess over the air by the closed form, and how far from it any facet's mean is [K].
struct SheetError {
    double largest, worst;
    NetworkCount count;
};

/// A fin heated over 0 < x < a of its length L, insulated ends, by day's end (Incropera 3.6), m² =
/// 2 h / (k t): q / (k t m²) (1 − sinh(m (L − a)) cosh(m x) / sinh(m L)), and beyond the foot q /
/// (k t m²) sinh(m a) cosh(m (L − x)) / sinh(m L).
inline SheetError heated_fin() {
    constexpr double length = 0.4, foot = 0.04, film = 12.5, heat = 6000.0, air = 290.0;
    constexpr int cells = 60;  // second order: 0.09 K with 40
    const Sheet fin = sheet(length, 0.05, cells, 8, network_column({aluminium}, FixedFlux{0.0}));
    NetworkForcing forcing = in_air(air, film, film);
    forcing.loads = [&](double, NetworkLoads& loads) {
        for (std::size_t f = 0; f < fin.centre.size(); ++f) {
            loads.outer[f] = fin.centre[f].x() < foot ? heat : 0.0;
        }
    };
    NetworkStepper stepper(fin.network);
    stepper.settle(air);
    for (int i = 0; i < 30; ++i) stepper.advance(3600.0, forcing);
    const double kt = 0.4, m = std::sqrt(2.0 * film / kt), most = heat / (kt * m * m);
    SheetError error{0.0, 0.0, stepper.count};
    for (std::size_t f = 0; f < fin.centre.size(); ++f) {
        const double exact = fin.mean(f, [&](const Eigen::Vector2d& p) {
            const double x = p.x(), all = std::sinh(m * length);
            return most * (x < foot ? 1.0 - std::sinh(m * (length - foot)) * std::cosh(m * x) / all
                                    : std::sinh(m * foot) * std::cosh(m * (length - x)) / all);
        });
        error.largest = std::max(error.largest, exact);
        error.worst = std::max(error.worst, std::abs(stepper.state.node[f] - air - exact));
    }
    return error;
}

/// cos(π x / a) cos(2π y / b) on an insulated plate of uneven triangles fades as exp(−(α (π² / a² +
/// 4π² / b²) + 2 h / C) t) (Carslaw & Jaeger 3.3): 100 s of it, in steps of 5.
inline SheetError fading_plate() {
    constexpr double a = 0.5, b = 0.8, film = 10.0, air = 300.0, seconds = 100.0;
    const Sheet plate = sheet(a, b, 24, 40, network_column({aluminium}, FixedFlux{0.0}), 0.25);
    NetworkStepper stepper(plate.network);
    stepper.settle(air);
    const auto pattern = [&](const Eigen::Vector2d& p) {
        return 20.0 * std::cos(pi * p.x() / a) * std::cos(2.0 * pi * p.y() / b);
    };
    for (std::size_t f = 0; f < plate.centre.size(); ++f) {
        stepper.state.node[f] += plate.mean(f, pattern);
    }
    for (int i = 0; i < 20; ++i) stepper.advance(seconds / 20, in_air(air, film, film));
    const double rate = 200.0 / (2700.0 * 900.0) * (pi * pi / (a * a) + 4.0 * pi * pi / (b * b)) +
                        2.0 * film / (0.002 * 2700.0 * 900.0);
    SheetError error{0.0, 0.0, stepper.count};
    for (std::size_t f = 0; f < plate.centre.size(); ++f) {
        const double exact = plate.mean(f, pattern) * std::exp(-rate * seconds);
        error.largest = std::max(error.largest, exact);
        error.worst = std::max(error.worst, std::abs(stepper.state.node[f] - air - exact));
    }
    return error;
}

}  // namespace diurna::testing
