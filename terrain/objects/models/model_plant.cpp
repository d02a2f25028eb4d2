#include <Eigen/Core>
#include <array>
#include <cmath>

#include "terrain/objects/models/families.hpp"
#include "terrain/objects/models/panel_box.hpp"
#include "terrain/objects/models/plates.hpp"
#include "terrain/objects/models/turned.hpp"

/// A fuel tank, a generator, a lattice mast.
namespace diurna {

namespace {

using Eigen::Vector3d;

}  // namespace

/// A lying cylinder 8 m long and 2.8 m wide on two saddles, half full: wetted below its middle.
void make_fuel_tank(Workpiece& work) {
    const std::size_t first = work.mesh.triangle.size();
    const double middle = 1.9, radius = 1.4;
    add_drum(work, "tank_dry", {0.0, -4.0, middle}, {0.0, 4.0, middle}, radius, 0.35);
    relabel(work, first, "tank_dry", "tank_wetted",
            [&](const Vector3d& at) { return at.z() < middle; });
    for (const double y : {-2.5, 2.5}) {
        PanelBox saddle{.part = "saddles",
                        .low = {-1.2, y - 0.25, 0.0},
                        .high = {1.2, y + 0.25, 0.6},
                        .radius = 0.0};
        saddle.bend = [=](const Vector3d& p) {  // its top follows the shell, 2 cm below
            const double shell =
                middle - std::sqrt((radius + 0.02) * (radius + 0.02) - p.x() * p.x());
            return Vector3d(p.x(), p.y(), p.z() / 0.6 * shell);
        };
        add_box(work, saddle);
    }
    add_drum(work, "fittings", {0.0, 1.0, 3.32}, {0.0, 1.0, 3.55}, 0.35, 0.03);
    add_drum(work, "fittings", {0.0, -1.5, 3.32}, {0.0, -1.5, 3.7}, 0.06, 0.01);
    add_bar(work, "fittings", {0.0, 4.03, 0.8}, {0.0, 4.5, 0.8}, 0.08);
    add_drum(work, "fittings", {0.0, 4.52, 0.8}, {0.0, 4.58, 0.8}, 0.16, 0.02);
    for (const double x : {-0.25, 0.25}) {  // ladder on the back head
        add_bar(work, "fittings", {x, -4.15, 0.1}, {x, -4.15, 3.4}, 0.025);
    }
    for (int rung = 0; rung < 11; ++rung) {
        const double z = 0.3 + 0.3 * rung;
        add_bar(work, "fittings", {-0.22, -4.15, z}, {0.22, -4.15, z}, 0.015);
    }
    add_grille(work, "fittings", {{-0.4, -4.0, 3.34}, Vector3d::UnitX(), Vector3d::UnitY()},
               {0.8, 2.2, 0.03}, 8);
}

/// A canopied diesel set on its skid: 3.4 m long, 1.3 m wide, 2.1 m high with its stack.
void make_generator(Workpiece& work) {
    add_box(work, "skid", {-0.6, -1.7, 0.0}, {0.6, 1.7, 0.28}, 0.03);
    PanelBox canopy{.part = "canopy",
                    .low = {-0.65, -1.7, 0.31},
                    .high = {0.65, 1.7, 1.75},
                    .radius = 0.06,
                    .panels = {{Side::front, -0.5, 0.5, 0.5, 1.55, "radiator", 0.06},
                               {Side::back, -0.5, 0.5, 0.5, 1.0, "intake", 0.06},
                               {Side::back, -0.3, 0.3, 1.15, 1.5, "panel", 0.04}}};
    for (const Side side : {Side::left, Side::right}) {
        for (const double y : {-1.4, -0.3, 0.8}) {
            canopy.panels.push_back({side, y, y + 0.9, 0.45, 1.6, "doors", 0.015});
        }
    }
    add_box(work, canopy);
    add_grille(work, "grille", {{-0.47, 1.66, 0.53}, Vector3d::UnitX(), Vector3d::UnitZ()},
               {0.94, 0.99, 0.02}, 12);
    add_grille(work, "grille", {{-0.47, -1.66, 0.53}, Vector3d::UnitX(), Vector3d::UnitZ()},
               {0.94, 0.44, 0.02}, 6);
    add_drum(work, "exhaust", {0.0, 0.2, 1.92}, {0.0, 1.1, 1.92}, 0.13, 0.03);
    add_bar(work, "exhaust", {0.0, 1.2, 1.78}, {0.0, 1.2, 2.1}, 0.05);
    for (const double y : {-1.45, 1.45}) {
        for (const double side : {-1.0, 1.0}) {
            add_drum(work, "fittings", {0.5 * side, y, 1.77}, {0.5 * side, y, 1.85}, 0.04, 0.01);
            add_bar(work, "fittings", {0.62 * side, y, 0.14}, {0.7 * side, y, 0.14}, 0.05);
        }
    }
    for (const double side : {-1.0, 1.0}) {
        for (const double y : {-0.58, 0.52, 1.62}) {  // handles
            add_bar(work, "fittings", {0.655 * side, y - 0.02, 1.0}, {0.69 * side, y - 0.02, 1.0},
                    0.02);
        }
    }
}

/// A square lattice mast of steel tubes, 21 m high, 1.6 m wide at its foot, with two dishes.
void make_mast(Workpiece& work) {
    add_box(work, "footing", {-1.2, -1.2, 0.0}, {1.2, 1.2, 0.3}, 0.02);
    constexpr int bays = 12;
    constexpr double foot = 0.34, height = 18.0;
    const auto half = [](double up) { return 0.8 - 0.5 * up / height; };
    const auto corner = [&](int k, double up) {
        const double x = k == 0 || k == 3 ? -1.0 : 1.0, y = k < 2 ? -1.0 : 1.0;
        return Vector3d(x * half(up), y * half(up), foot + up);
    };
    for (int k = 0; k < 4; ++k) {
        add_bar(work, "lattice", corner(k, 0.0), corner(k, height), 0.05);
        for (int bay = 0; bay < bays; ++bay) {
            const double low = height * bay / bays, high = height * (bay + 1) / bays;
            // Bars end short of the legs that they meet.
            const auto between = [](const Vector3d& a, const Vector3d& b, double radius) {
                const Vector3d way = (b - a).normalized() * (0.055 + radius);
                return std::array<Vector3d, 2>{a + way, b - way};
            };
            const int next = (k + 1) % 4;
            const bool left = (bay + k) % 2 == 0;
            const auto brace = between(corner(left ? k : next, low + 0.06),
                                       corner(left ? next : k, high - 0.06), 0.02);
            add_bar(work, "lattice", brace[0], brace[1], 0.02);
            const auto girt = between(corner(k, high), corner(next, high), 0.0);
            add_bar(work, "lattice", girt[0], girt[1], 0.025);
        }
    }
    add_box(work, "lattice", {-0.4, -0.4, 18.42}, {0.4, 0.4, 18.47}, 0.015);
    add_bar(work, "antennas", {0.0, 0.0, 18.5}, {0.0, 0.0, 21.0}, 0.04);
    add_drum(work, "antennas", {0.0, 0.46, 17.0}, {0.0, 0.86, 17.0}, 0.6, 0.12);
    add_drum(work, "antennas", {0.5, 0.0, 15.2}, {0.85, 0.0, 15.2}, 0.45, 0.1);
    add_box(work, "cabinet", {-0.45, 1.3, 0.05}, {0.45, 1.9, 1.7}, 0.03);
}

}  // namespace diurna
