#include "terrain/objects/models/turned.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace diurna {

namespace {

constexpr double on_axis = 1e-9;  // [m]

/// The profile with no piece longer than `edge`.
std::vector<ProfilePoint> divided(const std::vector<ProfilePoint>& profile, double edge) {
    std::vector<ProfilePoint> all;
    for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
        const ProfilePoint &a = profile[i], &b = profile[i + 1];
        const double length = std::hypot(b.radius - a.radius, b.along - a.along);
        if (length < on_axis) continue;
        const int steps = std::max(1, static_cast<int>(std::ceil(length / edge - 1e-6)));
        for (int k = 0; k < steps; ++k) {
            const double t = double(k) / steps;
            all.push_back(
                {a.radius + t * (b.radius - a.radius), a.along + t * (b.along - a.along), a.part});
        }
    }
    all.push_back(profile.back());
    return all;
}

}  // namespace

int circle_corners(const Fineness& fine, double radius, int finest) {
    const double by_edge = 2.0 * std::numbers::pi * radius / fine.edge;
    const int corners = std::max(4 * fine.arc, 4 * static_cast<int>(std::ceil(0.25 * by_edge)));
    return std::min(corners, finest);
}

void add_turned(Workpiece& work, const Eigen::Vector3d& origin, const Eigen::Vector3d& axis,
                const std::vector<ProfilePoint>& profile, int finest) {
    const std::size_t first = work.mesh.triangle.size();
    const Eigen::Vector3d along = axis.normalized();
    Eigen::Vector3d down = -Eigen::Vector3d::UnitZ();
    if (std::abs(along.z()) > 0.999) down = -Eigen::Vector3d::UnitY();
    down = (down - along * along.dot(down)).normalized();
    const Eigen::Vector3d across = along.cross(down);
    double widest = 0.0;
    for (const ProfilePoint& point : profile) widest = std::max(widest, point.radius);
    const int n = circle_corners(work.fine, widest, finest);
    const std::vector<ProfilePoint> all = divided(profile, work.fine.edge);
    std::vector<std::vector<std::uint32_t>> ring;
    for (const ProfilePoint& point : all) {
        ring.emplace_back();
        const Eigen::Vector3d middle = origin + along * point.along;
        for (int k = 0; k < (point.radius < on_axis ? 1 : n); ++k) {
            const double angle = 2.0 * std::numbers::pi * k / n;
            ring.back().push_back(add_vertex(
                work, middle + point.radius * (std::cos(angle) * down + std::sin(angle) * across)));
        }
    }
    for (std::size_t i = 0; i + 1 < all.size(); ++i) {
        const std::uint16_t part = part_of_name(work, all[i].part);
        const auto &a = ring[i], &b = ring[i + 1];
        for (int k = 0; k < n; ++k) {
            const auto here = std::size_t(k), next = std::size_t((k + 1) % n);
            if (a.size() == 1) {
                add_triangle(work, a[0], b[next], b[here], part);
            } else if (b.size() == 1) {
                add_triangle(work, a[here], a[next], b[0], part);
            } else {
                add_quad(work, {a[here], a[next], b[next], b[here]}, part);
            }
        }
    }
    finish_solid(work, first);
}

void add_bar(Workpiece& work, const std::string& part, const Eigen::Vector3d& from,
             const Eigen::Vector3d& to, double radius) {
    const double length = (to - from).norm();
    add_turned(work, from, to - from,
               {{0.0, 0.0, part}, {radius, 0.0, part}, {radius, length, part}, {0.0, length, part}},
               work.fine.arc < 3 ? 4 : 2 * work.fine.arc);
}

void add_drum(Workpiece& work, const std::string& part, const Eigen::Vector3d& from,
              const Eigen::Vector3d& to, double radius, double rounding) {
    const double length = (to - from).norm();
    std::vector<ProfilePoint> profile{{0.0, 0.0, part}};
    const int pieces = std::max(1, work.fine.arc_of(rounding));
    for (const bool end : {false, true}) {
        for (int k = 0; k <= pieces; ++k) {
            const double angle = 0.5 * std::numbers::pi * (end ? pieces - k : k) / pieces;
            const double r = radius - rounding * (1.0 - std::sin(angle));
            const double in = rounding * (1.0 - std::cos(angle));
            profile.push_back({r, end ? length - in : in, part});
        }
    }
    profile.push_back({0.0, length, part});
    add_turned(work, from, to - from, profile);
}

void add_wheel(Workpiece& work, const Eigen::Vector3d& centre, double radius, double width,
               const std::string& tyre, const std::string& disc) {
    const double half = 0.5 * width, rim = 0.58 * radius, dish = 0.15 * width,
                 shoulder = 0.12 * radius;
    const auto side = [&](double sign) -> std::vector<ProfilePoint> {
        std::vector<ProfilePoint> points{{0.0, sign * (half - 0.3 * dish), disc},
                                         {0.35 * rim, sign * (half - 0.3 * dish), disc},
                                         {0.5 * rim, sign * (half - dish), disc},
                                         {rim, sign * (half - dish), disc},
                                         {1.05 * rim, sign * half, tyre}};
        const int pieces = std::max(1, work.fine.arc_of(shoulder));
        for (int k = 0; k <= pieces; ++k) {
            const double angle = 0.5 * std::numbers::pi * k / pieces;
            points.push_back({radius - shoulder * (1.0 - std::sin(angle)),
                              sign * (half - shoulder * (1.0 - std::cos(angle))), tyre});
        }
        return points;
    };
    std::vector<ProfilePoint> profile = side(-1.0), far = side(1.0);
    // On the way back a piece is of the part of the point that it leads to.
    for (std::size_t i = far.size(); i-- > 0;) {
        profile.push_back({far[i].radius, far[i].along, i > 0 ? far[i - 1].part : disc});
    }
    // Narrow tyres, too, have round shoulders and no fewer corners than their rims.
    add_turned(work, centre, Eigen::Vector3d::UnitX(), profile, 48);
}

}  // namespace diurna
