#include "terrain/objects/box.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

/// Puts rectangles together; corners at the same place on the box's lattice are one vertex.
class BoxBuilder {
 public:
    explicit BoxBuilder(const BoxSpec& spec)
        : spec_(spec),
          parts_{parts(spec.width), parts(spec.depth), parts(spec.height + spec.sunk)} {
        const double heading = radians(spec.heading_deg);
        forward_ = {std::sin(heading), std::cos(heading), 0.0};
        right_ = {std::cos(heading), -std::sin(heading), 0.0};
    }

    /// A face of the box, spanned by lattice axes u and v, counterclockwise from outside; `fixed`
    /// is the place on the third axis.
    void face(int u, int v, bool u_backwards, int fixed, MaterialId material) {
        const int w = 3 - u - v;
        const auto corner = [&](int i, int j) {
            std::array<int, 3> cell{};
            cell[u] = u_backwards ? parts_[u] - i : i;
            cell[v] = j;
            cell[w] = fixed;
            return vertex(cell);
        };
        for (int j = 0; j < parts_[v]; ++j) {
            for (int i = 0; i < parts_[u]; ++i) {
                const std::uint32_t a = corner(i, j), b = corner(i + 1, j);
                const std::uint32_t c = corner(i + 1, j + 1), d = corner(i, j + 1);
                mesh_.triangle.push_back({a, b, c});
                mesh_.triangle.push_back({a, c, d});
                mesh_.material.insert(mesh_.material.end(), 2, material);
            }
        }
    }
    const std::array<int, 3>& lattice() const { return parts_; }
    ObjectMesh result() { return std::move(mesh_); }

 private:
    /// The diagonal of a square with this side is not longer than the largest edge.
    int parts(double length) const {
        return std::max(
            1, static_cast<int>(std::ceil(length * std::sqrt(2.0) / spec_.largest_edge - 1e-9)));
    }

    std::uint32_t vertex(const std::array<int, 3>& cell) {
        const auto [it, fresh] =
            number_.try_emplace(cell, static_cast<std::uint32_t>(mesh_.vertex.size()));
        if (fresh) {
            const double x = (double(cell[0]) / parts_[0] - 0.5) * spec_.width;
            const double y = (double(cell[1]) / parts_[1] - 0.5) * spec_.depth;
            const double z = double(cell[2]) / parts_[2] * (spec_.height + spec_.sunk) - spec_.sunk;
            const Eigen::Vector3d place =
                spec_.base + x * right_ + y * forward_ + z * Eigen::Vector3d::UnitZ();
            mesh_.vertex.push_back(place.cast<float>());
        }
        return it->second;
    }

    const BoxSpec& spec_;
    std::array<int, 3> parts_;  // across, along the heading, up
    Eigen::Vector3d forward_, right_;
    std::map<std::array<int, 3>, std::uint32_t> number_;
    ObjectMesh mesh_;
};

}  // namespace

ObjectMesh box(const BoxSpec& spec) {
    if (!(spec.width > 0.0 && spec.depth > 0.0 && spec.height > 0.0 && spec.sunk >= 0.0 &&
          spec.largest_edge > 0.0 && spec.base.allFinite() && std::isfinite(spec.heading_deg))) {
        throw InputError("building",
                         fmt::format("found a box of {} x {} x {} m, edges up to {} m; lengths are "
                                     "more than 0",
                                     spec.width, spec.depth, spec.height, spec.largest_edge));
    }
    BoxBuilder builder(spec);
    const auto [across, along, up] = builder.lattice();
    builder.face(0, 2, true, along, spec.front);   // looks along the heading
    builder.face(0, 2, false, 0, spec.wall);       // the back
    builder.face(1, 2, false, across, spec.wall);  // to the right of the heading
    builder.face(1, 2, true, 0, spec.wall);
    builder.face(0, 1, false, up, spec.roof);
    return builder.result();
}

}  // namespace diurna
