#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "terrain/objects/mesh_file.hpp"

/// Objects built by code: a mesh built solid by solid. x to the right, y to the front, z up
/// [m].
namespace diurna {

/// How finely solids are divided.
struct Fineness {
    double edge = 0.3;  // [m] lattices are divided until no step is longer
    int arc = 2;        // pieces of a rounded right angle; four times as many of a circle, at least

    /// Pieces of a right angle rounded by that radius: 1 (boxes: 2) below half an edge, 0 (sharp)
    /// below a tenth.
    int arc_of(double radius) const;
};

struct Workpiece {
    MeshFile mesh;
    Fineness fine;
};

/// The part of that name, a new one if it does not exist.
std::uint16_t part_of_name(Workpiece& work, const std::string& name);

std::uint32_t add_vertex(Workpiece& work, const Eigen::Vector3d& at);
void add_triangle(Workpiece& work, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                  std::uint16_t part);
/// Split along its shorter diagonal.
void add_quad(Workpiece& work, const std::array<std::uint32_t, 4>& corner, std::uint16_t part);

/// Volume enclosed by the triangles from this index on, by the divergence theorem [m³]; positive if
/// they face outward.
double enclosed_volume(const MeshFile& mesh, std::size_t first_triangle = 0);

/// Reverses the solid that begins with that triangle if it faces inward.
void finish_solid(Workpiece& work, std::size_t first_triangle);

/// Moves triangles of a part, from this index on, to another part: those whose centroid satisfies
/// the condition.
void relabel(Workpiece& work, std::size_t first_triangle, const std::string& from,
             const std::string& to, const std::function<bool(const Eigen::Vector3d&)>& fits);

/// Ascending, without duplicates (to a hundredth of a millimetre), with places inserted between
/// them until no step is longer than `edge`.
std::vector<double> refined(std::vector<double> places, double edge);

}  // namespace diurna
