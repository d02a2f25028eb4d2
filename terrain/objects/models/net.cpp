#include "terrain/objects/models/net.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "terrain/objects/models/plates.hpp"
#include "terrain/objects/models/workpiece.hpp"

namespace diurna {

namespace {

constexpr double hem = 0.1;  // [m] above the ground

/// The highest of points in each square of a lattice: no others hold the net.
std::vector<Eigen::Vector3d> highest_by_square(const std::vector<Eigen::Vector3d>& points,
                                               double edge) {
    std::map<std::pair<long, long>, Eigen::Vector3d> highest;
    for (const Eigen::Vector3d& p : points) {
        const std::pair square{std::lround(p.x() / edge), std::lround(p.y() / edge)};
        const auto [known, fresh] = highest.try_emplace(square, p);
        if (!fresh && p.z() > known->second.z()) known->second = p;
    }
    std::vector<Eigen::Vector3d> all;
    for (const auto& [square, point] : highest) all.push_back(point);
    return all;
}

/// Takes out what lies on the ground beyond the hem.
void drop_level_at(MeshFile& mesh, std::size_t first, double height) {
    std::size_t kept = first;
    for (std::size_t t = first; t < mesh.triangle.size(); ++t) {
        const auto corner = mesh.triangle[t];
        const bool level = std::all_of(corner.begin(), corner.end(), [&](std::uint32_t v) {
            return mesh.vertex[v].z() < height + 1e-6;
        });
        if (level) continue;
        mesh.part_of[kept] = std::uint16_t{mesh.part_of[t]};
        mesh.triangle[kept++] = corner;
    }
    mesh.triangle.resize(kept);
    mesh.part_of.resize(kept);
}

}  // namespace

void add_net(MeshFile& mesh, double clearance, double edge) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& p : mesh.vertex) box.extend(p);
    const double ground = box.min().z() + hem;
    const std::vector<Eigen::Vector3d> held = highest_by_square(mesh.vertex, 0.5 * edge);
    const auto height = [&](double x, double y) {
        double top = ground;
        for (const Eigen::Vector3d& p : held) {
            // Flat for as far as the net is clear of the point, then down.
            const double away = std::hypot(x - p.x(), y - p.y());
            top = std::max(top, p.z() + clearance - std::max(0.0, away - clearance - edge));
        }
        return top;
    };
    // One to one down to the hem.
    const double reach = 2.0 * clearance + 2.0 * edge + box.max().z() - ground;
    Workpiece work{.mesh = std::move(mesh), .fine = {}};
    const std::size_t first = work.mesh.triangle.size();
    add_sheet(work, "net", box.min().head<2>() - Eigen::Vector2d::Constant(reach),
              box.max().head<2>() + Eigen::Vector2d::Constant(reach), edge, height);
    work.mesh.part.back().material = "camouflage_net";
    mesh = std::move(work.mesh);
    drop_level_at(mesh, first, ground);
}

}  // namespace diurna
