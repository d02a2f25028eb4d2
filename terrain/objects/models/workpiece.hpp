#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "terrain/objects/mesh_file.hpp"

/// Objects built by code: a mesh that grows solid by solid. x to the right, y to the front, z up
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

/// The part of that name, a new one if there is none.
std::uint16_t part_of_name(Workpiece& work, const std::string& name);

std::uint32_t add_vertex(Workpiece& work, const Eigen::Vector3d& at);
void add_triangle(Workpiece& work, std::uint32_t a, std::uint32_t b, std::uint32_t c,
                  std::uint16_t part);
/// Cut along its shorter diagonal.
void add_quad(Workpiece& work, const std::array<std::uint32_t, 4>& corner, std::uint16_t part);

/// What triangles from the one of that number on enclose, by the divergence theorem [m³]; positive
/// where they look outward.
double enclosed_volume(const MeshFile& mesh, std::size_t first_triangle = 0);

/// Turns the solid that begins with that triangle outside out if it is inside out.
void finish_solid(Workpiece& work, std::size_t first_triangle);

/// Gives triangles of a part from the one of that number on to another part: those whose middle
/// fits.
void relabel(Workpiece& work, std::size_t first_triangle, const std::string& from,
             const std::string& to, const std::function<bool(const Eigen::Vector3d&)>& fits);

/// Ascending, each once (to a hundredth of a millimetre), further places between them until no step
/// is longer than `edge`.
std::vector<double> refined(std::vector<double> places, double edge);

}  // namespace diurna
