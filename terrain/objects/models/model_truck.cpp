#include <Eigen/Core>
#include <algorithm>

#include "terrain/objects/models/families.hpp"
#include "terrain/objects/models/panel_box.hpp"
#include "terrain/objects/models/plates.hpp"
#include "terrain/objects/models/turned.hpp"

/// A six-wheeled cargo truck with a bonnet and a canvas cover: 7.2 m long, 2.4 m wide, 2.95 m high.
namespace diurna {

namespace {

using Eigen::Vector3d;

void add_cab(Workpiece& work) {
    constexpr double belt = 1.75;  // height where windows begin
    PanelBox cab{.part = "cab",
                 .low = {-1.15, 0.85, 1.08},
                 .high = {1.15, 2.35, 2.55},
                 .radius = 0.1,
                 .panels = {{Side::front, -1.0, 1.0, belt, 2.38, "windows", 0.02},
                            {Side::left, 1.15, 2.05, belt, 2.36, "windows", 0.02},
                            {Side::right, 1.15, 2.05, belt, 2.36, "windows", 0.02},
                            {Side::back, -0.6, 0.6, 1.85, 2.3, "windows", 0.02}}};
    cab.bend = [](const Vector3d& p) {
        const double above = std::max(0.0, p.z() - belt);
        const double forward = std::clamp((p.y() - 0.85) / 1.5, 0.0, 1.0);
        return Vector3d(p.x() * (1.0 - 0.06 * above), p.y() - 0.3 * forward * above, p.z());
    };
    add_box(work, cab);
    for (const double side : {-1.0, 1.0}) {
        add_bar(work, "fittings", {1.19 * side, 2.2, 1.6}, {1.38 * side, 2.22, 1.75}, 0.015);
        const double in = std::min(1.31 * side, 1.45 * side),
                     out = std::max(1.31 * side, 1.45 * side);
        add_box(work, "fittings", {in, 2.21, 1.78}, {out, 2.26, 2.12}, 0.02);
    }
}

void add_hood(Workpiece& work) {
    PanelBox hood{.part = "hood",
                  .low = {-0.78, 2.38, 1.0},
                  .high = {0.78, 3.5, 1.72},
                  .radius = 0.1,
                  .panels = {{Side::front, -0.6, 0.6, 1.12, 1.6, "radiator", 0.06}}};
    hood.bend = [](const Vector3d& p) {  // lower and narrower in front
        const double forward = (p.y() - 2.38) / 1.12;
        return Vector3d(p.x() * (1.0 - 0.05 * forward), p.y(),
                        p.z() - 0.1 * forward * std::max(0.0, p.z() - 1.0) / 0.72);
    };
    add_box(work, hood);
    add_grille(work, "grille", {{-0.55, 3.485, 1.13}, Vector3d::UnitX(), Vector3d::UnitZ()},
               {1.1, 0.38, 0.02}, 6);
    for (const double side : {-1.0, 1.0}) {
        const double in = std::min(0.8 * side, 1.2 * side), out = std::max(0.8 * side, 1.2 * side);
        PanelBox fender{
            .part = "fenders", .low = {in, 2.38, 1.08}, .high = {out, 3.45, 1.2}, .radius = 0.05};
        fender.bend = [](const Vector3d& p) {
            const double away = (p.y() - 2.75) / 0.7;
            return Vector3d(p.x(), p.y(), p.z() - 0.25 * std::max(0.0, away * away * away));
        };
        add_box(work, fender);
        add_drum(work, "lamps", {1.0 * side, 3.48, 1.02}, {1.0 * side, 3.56, 1.02}, 0.1, 0.03);
    }
    add_box(work, "chassis", {-1.18, 3.52, 0.55}, {1.18, 3.66, 0.8}, 0.05);
}

void add_chassis(Workpiece& work) {
    std::vector<Hole> holes;
    for (int i = 0; i < 5; ++i) {
        holes.push_back({0.1, 0.8, 0.15 + 1.35 * i, 1.35 + 1.35 * i});
    }
    add_plate(work, "chassis", {{-0.45, -3.4, 0.72}, Vector3d::UnitX(), Vector3d::UnitY()},
              {0.9, 6.85, 0.22}, holes);
    for (const double y : {2.75, -1.25, -2.55}) {
        for (const double side : {-1.0, 1.0}) {
            add_wheel(work, {1.0 * side, y, 0.5}, 0.5, 0.36);
        }
        add_bar(work, "chassis", {-0.8, y, 0.5}, {0.8, y, 0.5}, 0.07);
    }
    add_drum(work, "fuel_tank", {-0.85, 0.0, 0.68}, {-0.85, 1.1, 0.68}, 0.28, 0.05);
    add_box(work, "chassis", {0.62, 0.1, 0.45}, {1.1, 0.9, 0.92}, 0.04);  // batteries, tools
    add_drum(work, "exhaust", {0.98, 0.66, 1.1}, {0.98, 0.66, 1.9}, 0.11, 0.03);
    add_bar(work, "exhaust", {0.98, 0.66, 1.92}, {0.98, 0.66, 2.85}, 0.05);
}

void add_bed(Workpiece& work) {
    add_box(work, "bed", {-1.2, -3.6, 1.08}, {1.2, 0.5, 1.2}, 0.03);
    for (const double side : {-1.0, 1.0}) {
        const double in = std::min(1.15 * side, 1.2 * side),
                     out = std::max(1.15 * side, 1.2 * side);
        add_box(work, "bed", {in, -3.6, 1.22}, {out, 0.5, 1.62}, 0.015);
    }
    add_box(work, "bed", {-1.13, -3.6, 1.22}, {1.13, -3.55, 1.62}, 0.015);
    add_box(work, "bed", {-1.13, 0.45, 1.22}, {1.13, 0.5, 1.62}, 0.015);
    PanelBox cover{
        .part = "canvas", .low = {-1.18, -3.58, 1.65}, .high = {1.18, 0.48, 2.75}, .radius = 0.15};
    for (int bow = 1; bow < 5; ++bow) {  // the cloth hangs between bows
        cover.further_lines[1].push_back(-3.58 + 4.06 * bow / 5.0);
    }
    cover.bend = [](const Vector3d& p) {
        const double up = (p.z() - 1.65) / 1.1, off = p.x() / 1.18;
        return Vector3d(p.x(), p.y(), p.z() + 0.2 * up * (1.0 - off * off));
    };
    add_box(work, cover);
}

}  // namespace

void make_truck(Workpiece& work) {
    add_cab(work);
    add_hood(work);
    add_chassis(work);
    add_bed(work);
}

}  // namespace diurna
