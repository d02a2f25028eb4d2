#include "terrain/objects/box.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "terrain/objects/walls.hpp"

namespace diurna {

namespace {

/// A level rectangle of (east, north) corners, counterclockwise, in a lattice.
void append_roof(const Ring& plan, double height, double side, MaterialId material,
                 ObjectMesh& mesh) {
    const auto parts = [&](const Eigen::Vector2d& way) {
        return std::max(1u, static_cast<std::uint32_t>(std::ceil(way.norm() / side - 1e-9)));
    };
    const std::uint32_t across = parts(plan[1] - plan[0]), along = parts(plan[3] - plan[0]);
    const auto first = static_cast<std::uint32_t>(mesh.vertex.size());
    const auto on = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b, std::uint32_t k,
                       std::uint32_t parts_of_it) {
        return k == parts_of_it ? b : Eigen::Vector2d(a + double(k) / parts_of_it * (b - a));
    };
    for (std::uint32_t v = 0; v <= along; ++v) {
        const Eigen::Vector2d left = on(plan[0], plan[3], v, along);
        const Eigen::Vector2d right = on(plan[1], plan[2], v, along);
        for (std::uint32_t u = 0; u <= across; ++u) {
            const Eigen::Vector2d p = on(left, right, u, across);
            mesh.vertex.push_back(Eigen::Vector3d(p.x(), p.y(), height).cast<float>());
        }
    }
    for (std::uint32_t v = 0; v < along; ++v) {
        for (std::uint32_t u = 0; u < across; ++u) {
            const std::uint32_t a = first + v * (across + 1) + u, c = a + across + 2;
            mesh.triangle.push_back({a, a + 1, c});
            mesh.triangle.push_back({a, c, c - 1});
            mesh.material.insert(mesh.material.end(), 2, material);
        }
    }
}

}  // namespace

Ring plan_of(const BoxSpec& spec) {
    const double heading = radians(spec.heading_deg);
    const Eigen::Vector2d ahead(std::sin(heading), std::cos(heading));
    const Eigen::Vector2d right(ahead.y(), -ahead.x());
    Ring ring;
    for (const auto& [x, y] : {std::pair{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}) {
        ring.push_back(spec.base.head<2>() + x * spec.width * right + y * spec.depth * ahead);
    }
    return ring;
}

ObjectMesh box(const BoxSpec& spec) {
    if (!(spec.width > 0.0 && spec.depth > 0.0 && spec.height > 0.0 && spec.sunk >= 0.0 &&
          spec.largest_edge > 0.0 && spec.lowest_row > 0.0 && spec.base.allFinite() &&
          std::isfinite(spec.heading_deg))) {
        throw InputError(
            "building",
            fmt::format(
                "found a box of {} x {} x {} m with edges up to {} m, expected lengths above 0",
                spec.width, spec.depth, spec.height, spec.largest_edge));
    }
    const Ring plan = plan_of(spec);
    const double top = spec.base.z() + spec.height;
    // The diagonal of a square with this side is the largest edge.
    const double side = spec.largest_edge / std::sqrt(2.0);
    ObjectMesh mesh;
    append_walls({.ring = plan,
                  .bottom = spec.base.z() - spec.sunk,
                  .top = top,
                  .side = side,
                  .lowest_row = spec.lowest_row,
                  .foot = spec.foot,
                  .material = {spec.wall, spec.wall, spec.front, spec.wall}},
                 mesh);
    append_roof(plan, top, side, spec.roof, mesh);
    return welded(mesh);
}

}  // namespace diurna
