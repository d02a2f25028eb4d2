#include "terrain/objects/models/workpiece.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace diurna {

int Fineness::arc_of(double radius) const {
    return radius < 0.1 * edge ? 0 : radius < 0.5 * edge ? 1 : arc;
}

std::uint16_t part_of_name(Workpiece& work, const std::string& name) {
    auto& parts = work.mesh.part;
    const auto known = std::find_if(parts.begin(), parts.end(),
                                    [&](const MeshFile::Part& part) { return part.node == name; });
    if (known != parts.end()) return static_cast<std::uint16_t>(known - parts.begin());
    parts.push_back({.node = name, .material = ""});
    return static_cast<std::uint16_t>(parts.size() - 1);
}

std::uint32_t add_vertex(Workpiece& work, const Eigen::Vector3d& at) {
    work.mesh.vertex.push_back(at);
    return static_cast<std::uint32_t>(work.mesh.vertex.size() - 1);
}

void add_triangle(Workpiece& work, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                  std::uint16_t part) {
    work.mesh.triangle.push_back({a, b, c});
    work.mesh.part_of.push_back(part);
}

void add_quad(Workpiece& work, const std::array<std::uint32_t, 4>& corner, std::uint16_t part) {
    const auto [a, b, c, d] = corner;
    const auto& at = work.mesh.vertex;
    // A thousandth decides: rounding must not turn the diagonals of like quads this way and that.
    if ((at[a] - at[c]).norm() <= 1.001 * (at[b] - at[d]).norm()) {
        add_triangle(work, a, b, c, part);
        add_triangle(work, a, c, d, part);
    } else {
        add_triangle(work, a, b, d, part);
        add_triangle(work, b, c, d, part);
    }
}

double enclosed_volume(const MeshFile& mesh, std::size_t first_triangle) {
    double volume = 0.0;
    if (first_triangle >= mesh.triangle.size()) return volume;
    const Eigen::Vector3d origin = mesh.vertex[mesh.triangle[first_triangle][0]];
    for (std::size_t t = first_triangle; t < mesh.triangle.size(); ++t) {
        const auto& [a, b, c] = mesh.triangle[t];
        const Eigen::Vector3d p = mesh.vertex[a] - origin, q = mesh.vertex[b] - origin,
                              r = mesh.vertex[c] - origin;
        volume += p.dot(q.cross(r)) / 6.0;
    }
    return volume;
}

void finish_solid(Workpiece& work, std::size_t first_triangle) {
    if (enclosed_volume(work.mesh, first_triangle) >= 0.0) return;
    for (std::size_t t = first_triangle; t < work.mesh.triangle.size(); ++t) {
        std::swap(work.mesh.triangle[t][1], work.mesh.triangle[t][2]);
    }
}

void relabel(Workpiece& work, std::size_t first_triangle, const std::string& from,
             const std::string& to, const std::function<bool(const Eigen::Vector3d&)>& fits) {
    const std::uint16_t old = part_of_name(work, from), next = part_of_name(work, to);
    MeshFile& mesh = work.mesh;
    for (std::size_t t = first_triangle; t < mesh.triangle.size(); ++t) {
        const auto& [a, b, c] = mesh.triangle[t];
        if (mesh.part_of[t] != old) continue;
        if (fits((mesh.vertex[a] + mesh.vertex[b] + mesh.vertex[c]) / 3.0)) mesh.part_of[t] = next;
    }
}

std::vector<double> refined(std::vector<double> places, double edge) {
    constexpr double same = 1e-5;  // [m]
    std::sort(places.begin(), places.end());
    std::vector<double> all;
    for (const double place : places) {
        if (all.empty()) {
            all.push_back(place);
            continue;
        }
        const double from = all.back(), gap = place - from;
        if (gap < same) continue;
        const int steps = std::max(1, static_cast<int>(std::ceil(gap / edge - 1e-6)));
        for (int i = 1; i < steps; ++i) all.push_back(from + gap * i / steps);
        all.push_back(place);
    }
    return all;
}

}  // namespace diurna
