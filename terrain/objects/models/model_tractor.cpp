#include <Eigen/Core>
#include <algorithm>

#include "terrain/objects/models/families.hpp"
#include "terrain/objects/models/panel_box.hpp"
#include "terrain/objects/models/plates.hpp"
#include "terrain/objects/models/turned.hpp"

/// A road tractor with its cab over the engine, and a box trailer: 15.7 m long, 2.5 m wide, 3.9 m
/// high.
namespace diurna {

namespace {

using Eigen::Vector3d;

void add_tractor_cab(Workpiece& work) {
    constexpr double belt = 2.05;
    PanelBox cab{.part = "cab",
                 .low = {-1.22, 5.5, 1.12},
                 .high = {1.22, 7.6, 3.3},
                 .radius = 0.15,
                 .panels = {{Side::front, -1.05, 1.05, belt, 2.85, "windows", 0.02},
                            {Side::front, -0.8, 0.8, 1.3, 1.8, "radiator", 0.06},
                            {Side::left, 6.45, 7.3, belt, 2.8, "windows", 0.02},
                            {Side::right, 6.45, 7.3, belt, 2.8, "windows", 0.02}}};
    cab.bend = [](const Vector3d& p) {
        const double above = std::max(0.0, p.z() - belt);
        const double forward = std::clamp((p.y() - 5.5) / 2.1, 0.0, 1.0);
        return Vector3d(p.x(), p.y() - 0.2 * forward * above, p.z());
    };
    add_box(work, cab);
    add_grille(work, "grille", {{-0.75, 7.585, 1.33}, Vector3d::UnitX(), Vector3d::UnitZ()},
               {1.5, 0.44, 0.02}, 5);
    add_box(work, "engine_cover", {-0.5, 5.6, 0.62}, {0.5, 7.3, 1.08}, 0.08);
    add_box(work, "chassis", {-1.2, 7.3, 0.35}, {1.2, 7.62, 1.06}, 0.08);
    for (const double side : {-1.0, 1.0}) {
        add_drum(work, "lamps", {0.95 * side, 7.64, 0.75}, {0.95 * side, 7.68, 0.75}, 0.11, 0.02);
        add_bar(work, "fittings", {1.26 * side, 7.3, 2.6}, {1.42 * side, 7.45, 2.7}, 0.02);
        const double in = std::min(1.34 * side, 1.5 * side),
                     out = std::max(1.34 * side, 1.5 * side);
        add_box(work, "fittings", {in, 7.44, 2.1}, {out, 7.5, 2.65}, 0.02);
    }
}

void add_tractor_frame(Workpiece& work) {
    add_plate(work, "chassis", {{-0.45, 2.5, 0.78}, Vector3d::UnitX(), Vector3d::UnitY()},
              {0.9, 3.05, 0.22}, {{0.1, 0.8, 0.15, 1.2}, {0.1, 0.8, 1.4, 2.85}});
    add_drum(work, "chassis", {0.0, 3.35, 1.02}, {0.0, 3.35, 1.12}, 0.45, 0.03);
    for (const double side : {-1.0, 1.0}) {
        add_wheel(work, {1.04 * side, 6.75, 0.5}, 0.5, 0.34);
        for (const double x : {1.05, 0.7}) add_wheel(work, {x * side, 3.2, 0.5}, 0.5, 0.31);
    }
    add_bar(work, "chassis", {-0.5, 3.2, 0.5}, {0.5, 3.2, 0.5}, 0.09);
    add_drum(work, "fuel_tank", {0.9, 4.2, 0.65}, {0.9, 5.4, 0.65}, 0.3, 0.06);
    add_drum(work, "exhaust", {-0.9, 4.6, 0.6}, {-0.9, 5.4, 0.6}, 0.25, 0.05);
    add_bar(work, "exhaust", {-0.9, 5.38, 0.88}, {-0.9, 5.38, 3.1}, 0.07);
}

void add_trailer(Workpiece& work) {
    PanelBox body{.part = "trailer",
                  .low = {-1.25, -7.9, 1.16},
                  .high = {1.25, 4.7, 3.9},
                  .radius = 0.05,
                  .panels = {{Side::back, -1.15, -0.02, 1.3, 3.78, "trailer_doors", 0.015},
                             {Side::back, 0.02, 1.15, 1.3, 3.78, "trailer_doors", 0.015}}};
    body.side_part[std::size_t(Side::bottom)] = "trailer_floor";
    add_box(work, body);
    for (const double x : {-0.2, 0.2}) {
        add_bar(work, "fittings", {x, -7.93, 1.35}, {x, -7.93, 3.75}, 0.018);
    }
    add_plate(work, "chassis", {{-0.5, -7.6, 0.9}, Vector3d::UnitX(), Vector3d::UnitY()},
              {1.0, 9.8, 0.22}, {{0.1, 0.9, 0.3, 3.0}, {0.1, 0.9, 3.3, 6.3}, {0.1, 0.9, 6.6, 9.5}});
    for (const double y : {-3.8, -5.1, -6.4}) {
        for (const double side : {-1.0, 1.0}) add_wheel(work, {1.04 * side, y, 0.5}, 0.5, 0.38);
        add_bar(work, "chassis", {-0.84, y, 0.5}, {0.84, y, 0.5}, 0.07);
    }
    for (const double side : {-1.0, 1.0}) {
        add_box(work, "chassis", {0.7 * side - 0.06, 1.6, 0.25}, {0.7 * side + 0.06, 1.72, 1.13},
                0.02);
        add_box(work, "chassis", {0.7 * side - 0.15, 1.5, 0.2}, {0.7 * side + 0.15, 1.82, 0.24},
                0.01);
        add_box(work, "chassis", {1.18 * side - 0.02, -3.1, 0.5}, {1.18 * side + 0.02, 1.3, 0.95},
                0.015);
    }
    add_box(work, "chassis", {-1.2, -7.85, 0.5}, {1.2, -7.75, 0.65}, 0.03);  // rear guard
}

}  // namespace

void make_tractor_and_trailer(Workpiece& work) {
    add_tractor_cab(work);
    add_tractor_frame(work);
    add_trailer(work);
}

}  // namespace diurna
