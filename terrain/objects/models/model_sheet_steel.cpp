#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "terrain/objects/models/families.hpp"
#include "terrain/objects/models/panel_box.hpp"
#include "terrain/objects/models/plates.hpp"
#include "terrain/objects/models/turned.hpp"

/// A shed and a container of corrugated sheet steel.
namespace diurna {

namespace {

using Eigen::Vector3d;

/// How far corrugated sheet lies in at a place along it: trapezes of equal flanks.
double corrugation(double along, double pitch, double depth) {
    const double phase = along / pitch - std::floor(along / pitch);
    return depth * std::clamp(1.5 - 6.0 * std::abs(phase - 0.5), 0.0, 1.0);
}

/// Where its folds are.
std::vector<double> folds(double from, double to, double pitch) {
    std::vector<double> all;
    for (double fold = std::ceil(from / pitch) * pitch; fold < to - 1e-9; fold += pitch) {
        for (const double share : {0.25, 5.0 / 12.0, 7.0 / 12.0, 0.75}) {
            if (fold + share * pitch < to) all.push_back(fold + share * pitch);
        }
    }
    return all;
}

}  // namespace

/// A freight container by ISO 668's outer measures of 20 feet: 6.058 x 2.438 x 2.591 m.
void make_container(Workpiece& work) {
    constexpr double half_width = 1.219, half_length = 3.029, height = 2.591;
    constexpr double post = 0.16, pitch = 0.28, depth = 0.036;
    const bool fine = work.fine.arc > 3;  // a lattice of its folds
    PanelBox box{.part = "walls",
                 .low = {-half_width, -half_length + 0.03, 0.0},
                 .high = {half_width, half_length, height},
                 .panels = {{Side::back, -1.12, -0.015, post, height - 0.12, "doors", 0.04},
                            {Side::back, 0.015, 1.12, post, height - 0.12, "doors", 0.04}}};
    box.side_part[std::size_t(Side::top)] = "roof";
    box.side_part[std::size_t(Side::bottom)] = "floor";
    box.further_lines[1] = folds(-half_length + post, half_length - post, pitch);
    box.further_lines[1].insert(box.further_lines[1].end(),
                                {-half_length + post, half_length - post});
    box.further_lines[2] = {post, height - 0.12};
    if (fine) box.further_lines[0] = folds(-half_width + post, half_width - post, pitch);
    box.bend = [=](const Vector3d& p) {
        Vector3d bent = p;
        const bool between_rails = p.z() > post - 1e-9 && p.z() < height - 0.12 + 1e-9;
        if (between_rails && std::abs(std::abs(p.x()) - half_width) < 1e-9 &&
            std::abs(p.y()) < half_length - post + 1e-9) {
            bent.x() -= std::copysign(corrugation(p.y(), pitch, depth), p.x());
        }
        if (fine && between_rails && std::abs(p.y() - half_length) < 1e-9 &&
            std::abs(p.x()) < half_width - post + 1e-9) {
            bent.y() -= corrugation(p.x(), pitch, depth);
        }
        return bent;
    };
    add_box(work, box);
    for (const double x : {-0.85, -0.3, 0.3, 0.85}) {  // the doors' rods
        add_bar(work, "fittings", {x, -half_length + 0.02, 0.1}, {x, -half_length + 0.02, 2.5},
                0.02);
        add_box(work, "fittings", {x - 0.15, -half_length + 0.001, 1.0},
                {x - 0.03, -half_length + 0.025, 1.06}, 0.005);
    }
}

/// A shed of corrugated sheet, 8 x 12 m, 3.2 m to the eaves, 4.6 m to the ridge along y.
void make_steel_shed(Workpiece& work) {
    constexpr double half = 4.0, eaves = 3.2, roof_foot = 3.35, top = 3.8, ridge = 4.6, pitch = 0.5,
                     depth = 0.05;
    PanelBox shed{.part = "walls",
                  .low = {-half, -6.0, 0.0},
                  .high = {half, 6.0, top},
                  .panels = {{Side::front, -1.8, 1.8, 0.05, 2.9, "door", 0.12},
                             {Side::back, 1.5, 2.5, 0.05, 2.1, "door", 0.06},
                             {Side::back, -2.5, -1.3, 1.2, 2.1, "windows", 0.04}}};
    shed.side_part[std::size_t(Side::top)] = "roof";
    shed.side_part[std::size_t(Side::bottom)] = "floor";
    shed.further_lines[0] = {0.0};
    shed.further_lines[1] = folds(-5.8, 5.8, pitch);
    shed.further_lines[2] = {0.2, eaves};
    shed.bend = [=](const Vector3d& p) {
        const double up = std::max(0.0, (p.z() - eaves) / (top - eaves));
        const double roof = ridge - (ridge - roof_foot) * std::abs(p.x()) / half;
        Vector3d bent(p.x(), p.y(), std::min(p.z(), eaves) + up * (roof - eaves));
        const bool sheet = p.z() > 0.2 - 1e-9 && p.z() < eaves + 1e-9;
        if (sheet && std::abs(std::abs(p.x()) - half) < 1e-9) {
            bent.x() -= std::copysign(corrugation(p.y(), pitch, depth), p.x());
        }
        return bent;
    };
    add_box(work, shed);
    add_drum(work, "vents", {0.0, 0.0, 4.63}, {0.0, 0.0, 5.1}, 0.3, 0.05);
    add_box(work, "fittings", {-1.95, 6.02, 2.95}, {1.95, 6.3, 3.2}, 0.03);  // the door's roll
    for (const double side : {-1.0, 1.0}) {
        add_drum(work, "gutters", {4.09 * side, -6.0, 3.1}, {4.09 * side, 6.0, 3.1}, 0.07, 0.02);
        add_bar(work, "gutters", {4.07 * side, 6.07, 0.05}, {4.07 * side, 6.07, 3.0}, 0.04);
    }
}

}  // namespace diurna
