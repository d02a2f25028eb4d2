#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "terrain/objects/models/families.hpp"
#include "terrain/objects/models/panel_box.hpp"
#include "terrain/objects/models/turned.hpp"

/// A twin-engined propeller aircraft with a high wing, parked: 14.4 m long, 17 m span, 5.2 m high.
namespace diurna {

namespace {

using Eigen::Vector3d;

constexpr double axis = 1.75, girth = 0.95;  // height and radius of the fuselage [m]

/// A square section made round, as concentric squares go over into circles.
Vector3d round_section(const Vector3d& p) {
    const double x = p.x(), z = p.z(), far = std::hypot(x, z);
    const double scale = far > 0.0 ? std::max(std::abs(x), std::abs(z)) / far : 1.0;
    return {x * scale, p.y(), z * scale};
}

/// The fuselage's radius and the height of its axis over `axis`, along it.
double radius_at(double y) {
    if (y > 3.6) return girth * std::sqrt(std::max(0.03, 1.0 - std::pow((y - 3.6) / 2.5, 2.0)));
    if (y < -1.8) return girth * (1.0 - 0.8 * std::pow((-1.8 - y) / 6.0, 1.3));
    return girth;
}
double rise_at(double y) {
    return y < -1.8 ? 0.65 * std::pow((-1.8 - y) / 6.0, 1.3) : y > 3.6 ? -0.05 * (y - 3.6) : 0.0;
}

void add_fuselage(Workpiece& work) {
    PanelBox body{.part = "fuselage",
                  .low = {-girth, -7.8, -girth},
                  .high = {girth, 6.0, girth},
                  .panels = {{Side::top, -0.75, -0.06, 3.9, 4.6, "windows"},
                             {Side::top, 0.06, 0.75, 3.9, 4.6, "windows"},
                             {Side::left, 3.7, 4.5, 0.25, 0.75, "windows"},
                             {Side::right, 3.7, 4.5, 0.25, 0.75, "windows"}}};
    for (const double y : {-0.9, 0.0, 0.9, 1.8, 2.7}) {
        for (const Side side : {Side::left, Side::right}) {
            body.panels.push_back({side, y, y + 0.4, 0.15, 0.55, "windows"});
        }
    }
    for (int i = 0; i <= 12; ++i) {  // the nose is round
        body.further_lines[1].push_back(6.0 - 2.4 * std::pow(i / 12.0, 2.0));
    }
    for (double at = -0.75; at < 0.8; at += 0.25) {
        body.further_lines[0].push_back(at);
        body.further_lines[2].push_back(at);
    }
    body.bend = [](const Vector3d& p) {
        Vector3d bent = round_section(p);
        const double share = radius_at(p.y()) / girth;
        bent.x() *= share;
        bent.z() = axis + rise_at(p.y()) + bent.z() * share;
        return bent;
    };
    add_box(work, body);
}

/// A lifting surface: a rounded slab, thin behind and narrower outward.
///
/// taper  chord at its ends over that in its middle
PanelBox wing(const char* part, const Vector3d& low, const Vector3d& high, double taper,
              double dihedral) {
    const double half = high.x(), middle = 0.5 * (low.z() + high.z());
    const double front = high.y(), chord = high.y() - low.y(), quarter = front - 0.25 * chord;
    PanelBox box{.part = part, .low = low, .high = high, .radius = 0.35 * (high.z() - low.z())};
    box.bend = [=](const Vector3d& p) {
        const double out = std::abs(p.x()) / half, share = 1.0 - (1.0 - taper) * out;
        const double behind = (front - p.y()) / chord;  // 0 at the leading edge, 1 behind
        const double thick = share * std::max(0.12, 1.0 - 0.95 * std::max(0.0, behind - 0.25));
        return Vector3d(p.x(), quarter + (p.y() - quarter) * share,
                        middle + (p.z() - middle) * thick + dihedral * out);
    };
    return box;
}

void add_wings(Workpiece& work) {
    add_box(work, wing("wings", {-8.5, -0.2, 2.73}, {8.5, 1.9, 3.03}, 0.6, 0.15));
    add_box(work, wing("tail", {-3.0, -7.6, 4.95}, {3.0, -6.5, 5.1}, 0.7, 0.0));
    PanelBox fin{
        .part = "tail", .low = {-0.09, -7.7, 2.66}, .high = {0.09, -5.6, 4.92}, .radius = 0.06};
    fin.bend = [](const Vector3d& p) {
        const double up = (p.z() - 2.66) / 2.26, front = (p.y() + 7.7) / 2.1;
        return Vector3d(p.x(), p.y() - 0.9 * up * front, p.z());
    };
    add_box(work, fin);
}

void add_engines(Workpiece& work) {
    for (const double side : {-1.0, 1.0}) {
        const double x = 2.7 * side, z = 2.4;
        add_turned(work, {x, 0.2, z}, Vector3d::UnitY(),
                   {{0.0, 0.0, "nacelles"},
                    {0.12, 0.0, "nacelles"},
                    {0.24, 0.5, "nacelles"},
                    {0.29, 1.0, "nacelles"},
                    {0.3, 1.6, "nacelles"},
                    {0.28, 2.2, "nacelles"},
                    {0.2, 2.4, "intakes"},
                    {0.0, 2.42, "intakes"}});
        add_turned(work, {x, 2.66, z}, Vector3d::UnitY(),
                   {{0.0, 0.0, "propellers"},
                    {0.18, 0.0, "propellers"},
                    {0.16, 0.15, "propellers"},
                    {0.1, 0.28, "propellers"},
                    {0.0, 0.36, "propellers"}});
        for (int blade = 0; blade < 3; ++blade) {
            const double angle = 2.0943951 * blade + 0.3, c = std::cos(angle), s = std::sin(angle);
            PanelBox slab{.part = "propellers",
                          .low = {-0.09, 2.72, 0.2},
                          .high = {0.09, 2.76, 1.15},
                          .radius = 0.015};
            slab.bend = [=](const Vector3d& p) {
                return Vector3d(x + c * p.x() + s * p.z(), p.y(), z - s * p.x() + c * p.z());
            };
            add_box(work, slab);
        }
        add_bar(work, "exhausts", {x + 0.34 * side, 1.2, z - 0.05}, {x + 0.4 * side, 0.7, z - 0.1},
                0.07);
    }
}

void add_gear(Workpiece& work) {
    for (const double side : {-1.0, 1.0}) {
        add_wheel(work, {1.45 * side, -0.1, 0.36}, 0.36, 0.22);
        add_bar(work, "gear", {1.3 * side, -0.1, 0.4}, {0.85 * side, 0.0, 1.1}, 0.06);
    }
    add_wheel(work, {0.0, 4.5, 0.3}, 0.3, 0.18);
    for (const double x : {-0.13, 0.13}) add_bar(work, "gear", {x, 4.5, 0.3}, {x, 4.5, 0.75}, 0.03);
    add_bar(work, "gear", {0.0, 4.5, 0.65}, {0.0, 4.5, 0.86}, 0.06);
}

}  // namespace

void make_aircraft(Workpiece& work) {
    add_fuselage(work);
    add_wings(work);
    add_engines(work);
    add_gear(work);
}

}  // namespace diurna
