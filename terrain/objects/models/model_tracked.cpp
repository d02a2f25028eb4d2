#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "terrain/objects/models/families.hpp"
#include "terrain/objects/models/panel_box.hpp"
#include "terrain/objects/models/plates.hpp"
#include "terrain/objects/models/turned.hpp"

/// A tracked vehicle with a turret: hull 6.4 m long, 3.3 m wide over its tracks, 2.5 m high.
namespace diurna {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double track_in = 1.05, track_out = 1.6;

void add_hull(Workpiece& work) {
    PanelBox lower{
        .part = "hull", .low = {-1.0, -2.9, 0.42}, .high = {1.0, 2.9, 1.04}, .radius = 0.05};
    lower.bend = [](const Vector3d& p) {  // bow and stern rise
        const double up = (1.04 - p.z()) / 0.62;
        const double in = p.y() > 0.0 ? 0.25 : 0.12;
        return Vector3d(p.x(), p.y() * (1.0 - in * up), p.z());
    };
    add_box(work, lower);
    PanelBox upper{.part = "hull",
                   .low = {-1.62, -3.1, 1.07},
                   .high = {1.62, 3.1, 1.65},
                   .radius = 0.05,
                   .panels = {{Side::top, -1.2, 1.2, -2.85, -1.5, "engine_deck", 0.05},
                              {Side::back, -0.9, 0.9, 1.16, 1.5, "engine_deck", 0.04}}};
    upper.bend = [](const Vector3d& p) {  // the front plate leans back
        const double up = (p.z() - 1.07) / 0.58;
        const double forward = std::clamp((p.y() - 1.4) / 1.7, 0.0, 1.0);
        return Vector3d(p.x() * (1.0 - 0.04 * up), p.y() - 0.85 * forward * up, p.z());
    };
    add_box(work, upper);
    add_grille(work, "grille", {{-1.1, -2.8, 1.63}, Vector3d::UnitX(), Vector3d::UnitY()},
               {2.2, 1.25, 0.02}, 10);
    add_drum(work, "exhaust", {1.2, -3.35, 1.3}, {1.2, -3.12, 1.3}, 0.12, 0.02);
    for (const double side : {-1.0, 1.0}) {
        add_drum(work, "lamps", {1.2 * side, 2.98, 1.22}, {1.2 * side, 3.16, 1.22}, 0.09, 0.02);
        add_box(work, "fittings", {1.45 * side - 0.12, -1.0, 1.68}, {1.45 * side + 0.12, 0.6, 1.88},
                0.03);
    }
}

/// Points on a circle about `middle` from one angle to another.
void add_arc(std::vector<Vector2d>& path, const Vector2d& middle, double radius, double from_deg,
             double to_deg, int pieces) {
    for (int k = 0; k <= pieces; ++k) {
        const double angle =
            (from_deg + (to_deg - from_deg) * k / pieces) * std::numbers::pi / 180.0;
        path.push_back(middle + radius * Vector2d(std::cos(angle), std::sin(angle)));
    }
}

/// Straight pieces divided, points in one place once.
std::vector<Vector2d> divided(const std::vector<Vector2d>& path, double edge) {
    std::vector<Vector2d> all;
    for (std::size_t i = 0; i < path.size(); ++i) {
        const Vector2d &a = path[i], &b = path[(i + 1) % path.size()];
        const int steps = static_cast<int>(std::ceil((b - a).norm() / edge - 1e-6));
        for (int k = 0; k < steps; ++k) all.push_back(a + (b - a) * k / steps);
    }
    return all;
}

void add_running_gear(Workpiece& work) {
    const int pieces = 2 * work.fine.arc;
    std::vector<Vector2d> path;  // counterclockwise: (y, z), along the ground to the front
    add_arc(path, {2.1, 0.36}, 0.36, -90.0, -40.0, pieces / 2);
    add_arc(path, {2.7, 0.68}, 0.3, -40.0, 90.0, pieces);
    add_arc(path, {-2.65, 0.68}, 0.3, 90.0, 225.0, pieces);
    add_arc(path, {-2.05, 0.36}, 0.36, 225.0, 270.0, pieces / 2);
    path = divided(path, work.fine.edge);
    for (const double side : {-1.0, 1.0}) {
        const double from = std::min(side * track_in, side * track_out),
                     to = std::max(side * track_in, side * track_out);
        add_belt(work, "tracks", path, 0.05, from, to);
        const double x = 0.5 * (from + to);
        for (int i = 0; i < 6; ++i) {
            add_wheel(work, {x, -2.05 + 0.83 * i, 0.36}, 0.3, 0.4, "wheels", "discs");
        }
        for (const double y : {2.7, -2.65}) {
            add_wheel(work, {x, y, 0.68}, 0.24, 0.4, "discs", "discs");
        }
        PanelBox guard{.part = "skirts",
                       .low = {side * 1.66 - 0.02, -2.6, 0.62},
                       .high = {side * 1.66 + 0.02, 2.4, 1.1},
                       .radius = 0.015};
        add_box(work, guard);
    }
}

void add_turret(Workpiece& work) {
    PanelBox turret{.part = "turret",
                    .low = {-1.2, -1.3, 1.68},
                    .high = {1.2, 1.25, 2.3},
                    .radius = 0.12,
                    .panels = {{Side::front, 0.55, 0.85, 1.95, 2.1, "sight", 0.03}}};
    turret.bend = [](const Vector3d& p) {
        const double up = (p.z() - 1.68) / 0.62, forward = std::max(0.0, p.y() / 1.25);
        return Vector3d(p.x() * (1.0 - 0.15 * up) * (1.0 - 0.25 * forward * forward),
                        p.y() * (1.0 - 0.12 * up), p.z());
    };
    add_box(work, turret);
    add_box(work, "turret", {-0.3, 1.27, 1.82}, {0.3, 1.6, 2.16}, 0.06);
    add_bar(work, "barrel", {0.0, 1.62, 2.0}, {0.0, 4.6, 2.0}, 0.075);
    for (const double side : {-1.0, 1.0}) {
        add_drum(work, "turret", {0.45 * side, -0.35, 2.32}, {0.45 * side, -0.35, 2.42}, 0.3, 0.03);
    }
    add_box(work, "fittings", {-0.9, -1.62, 1.8}, {0.9, -1.33, 2.15}, 0.04);
    add_bar(work, "fittings", {-0.85, -1.0, 2.32}, {-0.85, -1.0, 2.5}, 0.05);
}

}  // namespace

void make_tracked_vehicle(Workpiece& work) {
    add_hull(work);
    add_running_gear(work);
    add_turret(work);
}

}  // namespace diurna
