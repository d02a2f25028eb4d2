#include "terrain/objects/prism.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "terrain/objects/cut_polygon.hpp"
#include "terrain/objects/joined_ring.hpp"
#include "terrain/objects/walls.hpp"

namespace diurna {

namespace {

/// Its corners, checked.
Ring tidy(const Ring& given, const std::string& where) {
    for (const auto& p : given) {
        if (!p.allFinite()) throw InputError(where, "a corner is not a finite number");
    }
    const Ring ring = counterclockwise(given);
    if (ring.size() < 3) {
        throw InputError(where, fmt::format("found {} corners, expected at least 3", ring.size()));
    }
    return ring;
}

/// Triangles of a simple ring by cutting off ears (Meisters 1975).
std::vector<std::array<std::uint32_t, 3>> ears(const Ring& ring, const std::string& where) {
    std::vector<std::uint32_t> left(ring.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<std::uint32_t>(i);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const auto is_ear = [&](std::size_t i) {
        const std::size_t n = left.size();
        const auto &a = ring[left[(i + n - 1) % n]], &b = ring[left[i]],
                   &c = ring[left[(i + 1) % n]];
        if (turn(a, b, c) < 0.0) return false;
        return std::none_of(left.begin(), left.end(), [&](std::uint32_t k) {
            const auto& p = ring[k];
            return &p != &a && &p != &b && &p != &c && turn(a, b, p) >= 0.0 &&
                   turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
        });
    };
    while (left.size() > 3) {
        std::size_t i = 0;
        while (i < left.size() && !is_ear(i)) ++i;
        if (i == left.size()) throw InputError(where, "its plan intersects itself");
        const std::size_t n = left.size();
        triangles.push_back({left[(i + n - 1) % n], left[i], left[(i + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (turn(ring[left[0]], ring[left[1]], ring[left[2]]) < 0.0) {
        throw InputError(where, "its plan intersects itself");
    }
    triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

}  // namespace

ObjectMesh prism(const PrismSpec& spec) {
    const Ring ring = tidy(spec.ring, spec.where);
    ObjectMesh mesh;
    append_walls({.ring = ring,
                  .bottom = spec.bottom,
                  .top = spec.top,
                  .side = spec.largest_edge,
                  .lowest_row = spec.largest_edge,
                  .foot = spec.foot,
                  .material = std::vector<MaterialId>(ring.size(), spec.wall)},
                 mesh);
    std::vector<Ring> courts;
    for (std::size_t i = 0; i < spec.hole.size(); ++i) {
        Ring court = court_of(spec.hole[i]);
        if (court.empty()) continue;
        append_walls(
            {.ring = court,
             .bottom = spec.bottom,
             .top = spec.top,
             .side = spec.largest_edge,
             .lowest_row = spec.largest_edge,
             .foot = i < spec.hole_foot.size() ? spec.hole_foot[i] : std::vector<Eigen::Vector3d>{},
             .material = std::vector<MaterialId>(court.size(), spec.wall)},
            mesh);
        courts.push_back(std::move(court));
    }
    const auto roof = static_cast<std::uint32_t>(mesh.vertex.size());
    const auto lay = [&](const Ring& corners,
                         const std::vector<std::array<std::uint32_t, 3>>& triangles) {
        for (const auto& p : corners) {
            mesh.vertex.push_back(Eigen::Vector3d(p.x(), p.y(), spec.top).cast<float>());
        }
        for (const auto& [a, b, c] : triangles) {
            mesh.triangle.push_back({roof + a, roof + b, roof + c});
            mesh.material.push_back(spec.roof);
        }
    };
    if (courts.empty()) {
        lay(ring, ears(ring, spec.where));
        return mesh;
    }
    const auto joined = joined_ring(ring, courts);
    std::vector<Eigen::Vector3d> corner;
    for (const Eigen::Vector2d& p : joined.value_or(Ring{})) corner.emplace_back(p.x(), p.y(), 0.0);
    const CutPolygon cut =
        joined ? cut_polygon(corner) : CutPolygon{.triangle = {}, .sound = false};
    if (!cut.sound) {
        throw InputError(
            spec.where,
            "a hole of its plan intersects the border or another hole, or is not inside",
            "repair the polygon with ogr2ogr -makevalid, or remove the hole");
    }
    lay(*joined, cut.triangle);
    return mesh;
}

Ring court_of(const Ring& hole) {
    constexpr double least_court = 0.1;  // [m²]
    Ring court = counterclockwise(hole);
    double twice = 0.0;
    for (std::size_t i = 0; i < court.size(); ++i) {
        const Eigen::Vector2d &a = court[i], &b = court[(i + 1) % court.size()];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    if (court.size() < 3 || !(0.5 * twice > least_court)) return {};
    std::reverse(court.begin(), court.end());
    return court;
}

}  // namespace diurna
