#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "materials/base/units.hpp"
#include "tests/support/sheet_scene.hpp"

/// Exchange between level ground and a level sheet over it by sums over squares of a metre, which
/// send each other by the view factor of a point to a rectangle (Modest, configuration 3).
namespace diurna::testing::over_plain {

/// View factor of a level point to the rectangle from its foot to (x, y), a height h over it.
inline double to_corner(double x, double y, double h) {
    const double u = x / h, v = y / h, p = std::sqrt(1.0 + u * u), q = std::sqrt(1.0 + v * v);
    return (u / p * std::atan(v / p) + v / q * std::atan(u / q)) / (2.0 * std::numbers::pi);
}
/// To the square of a metre whose middle is (x, y) away.
inline double to_square(double x, double y, double h) {
    const double a = x - 0.5, b = x + 0.5, c = y - 0.5, d = y + 0.5;
    return to_corner(b, d, h) - to_corner(a, d, h) - to_corner(b, c, h) + to_corner(a, c, h);
}

/// Squares of a metre on the ground and, over its middle, of a sheet.
struct Squares {
    static constexpr int ground = 30, sheet = 12;
    double height;
    std::vector<double> on_ground = std::vector<double>(ground * ground),
                        on_sheet = std::vector<double>(sheet * sheet);

    static Eigen::Vector2d middle(int k, int across) {
        return {k % across - 0.5 * (across - 1), k / across - 0.5 * (across - 1)};
    }
    static bool covered(int g) { return middle(g, ground).cwiseAbs().maxCoeff() < 0.5 * sheet; }
    /// Σ F × what the other squares send; `rest` from elsewhere in the hemisphere.
    double from_sheet(int g, const std::vector<double>& sent, double rest) const {
        return gathered(middle(g, ground), sheet, sent, rest);
    }
    double from_ground(int s, const std::vector<double>& sent, double rest) const {
        return gathered(middle(s, sheet), ground, sent, rest);
    }
    double gathered(const Eigen::Vector2d& at, int across, const std::vector<double>& sent,
                    double rest) const {
        double sum = 0.0, seen = 0.0;
        for (int k = 0; k < across * across; ++k) {
            const Eigen::Vector2d away = middle(k, across) - at;
            const double factor = to_square(away.x(), away.y(), height);
            sum += factor * sent[std::size_t(k)];
            seen += factor;
        }
        return sum + (1.0 - seen) * rest;
    }
    /// Mean over the ground's squares between two distances of the middle.
    double mean(double from, double to) const {
        double sum = 0.0;
        int count = 0;
        for (int g = 0; g < ground * ground; ++g) {
            const double away = middle(g, ground).cwiseAbs().maxCoeff();
            if (away < from || away > to) continue;
            sum += on_ground[std::size_t(g)];
            ++count;
        }
        return sum / count;
    }
};

/// Root of heat − n (σ T⁴ + film (T − air)).
inline double balanced(double heat, int faces) {
    double t = air;
    for (int i = 0; i < 50; ++i) {
        const double left = heat - faces * (stefan_boltzmann * power4(t) + film * (t - air));
        t += left / (faces * (4.0 * stefan_boltzmann * t * t * t + film));
    }
    return t;
}

/// 500 W/m² in a black sheet among surroundings as warm as the air: temperatures [K].
inline Squares under_heated_sheet() {
    const double cold = stefan_boltzmann * power4(air), heat = 500.0;
    Squares e{.height = 2.0};
    std::vector<double> ground(e.on_ground.size(), cold), sheet(e.on_sheet.size(), cold);
    for (int round = 0; round < 8; ++round) {
        for (std::size_t s = 0; s < sheet.size(); ++s) {
            e.on_sheet[s] = balanced(heat + cold + e.from_ground(int(s), ground, cold), 2);
        }
        for (std::size_t s = 0; s < sheet.size(); ++s) {
            sheet[s] = stefan_boltzmann * power4(e.on_sheet[s]);
        }
        for (std::size_t g = 0; g < ground.size(); ++g) {
            e.on_ground[g] = balanced(e.from_sheet(int(g), sheet, cold), 1);
        }
        for (std::size_t g = 0; g < ground.size(); ++g) {
            ground[g] = stefan_boltzmann * power4(e.on_ground[g]);
        }
    }
    return e;
}
/// What the program sets.
///
/// - back: a line for the sheet's material, or none
/// - again: the mesh has each square once more, reversed: from its last corner to its first
inline Solved heated_sheet(const std::string& back, bool again = false) {
    std::string mesh = level_square(12);
    for (int n = 0; again && n < 4 * 12 * 12; n += 4) {
        mesh += fmt::format("f {} {} {} {}\n", n + 4, n + 3, n + 2, n + 1);
    }
    return solved({.mesh = mesh,
                   .longwave = stefan_boltzmann * power4(air),
                   .sheet = "internal_heat_W_m2 = 500.0\n" + back});
}

}  // namespace diurna::testing::over_plain
