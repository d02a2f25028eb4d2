#pragma once

#include <Eigen/Core>
#include <vector>

#include "terrain/objects/mesh_file.hpp"
#include "terrain/objects/object_mesh.hpp"

namespace diurna {

/// The up axis of a file; its front faces +z if y is up (glTF), +y if z is up.
enum class UpAxis { y, z };

/// Position and orientation of a mesh in the scene.
struct Placing {
    Eigen::Vector3d base = Eigen::Vector3d::Zero();  // its middle in plan and its lowest point [m]
    double heading_deg = 0.0;                        // direction of its front, from north
    UpAxis up = UpAxis::y;
    double metres = 1.0;                     // per unit of the file
    double largest_edge = 0.5;               // longer edges are cut [m]
    double pitch_deg = 0.0, roll_deg = 0.0;  // front above, right side below level
};

/// Converts a file's axes, origin and unit to those of an object: right, front, up [m], from its
/// middle in plan and its lowest point.
class MeshFrame {
 public:
    MeshFrame(const MeshFile& mesh, const Placing& placing);
    Eigen::Vector3d place(const Eigen::Vector3d& vertex) const;
    Eigen::Vector3d direction(const Eigen::Vector3d& in_file) const;

 private:
    UpAxis up_;
    double metres_;
    Eigen::Vector3d foot_;
};

/// The mesh rotated, scaled and placed; long edges are halved until none is longer than
/// `largest_edge`: neighbours share the new vertices, so that no crack opens.
///
/// material  (part of the file)
ObjectMesh placed_mesh(const MeshFile& mesh, const Placing& placing,
                       const std::vector<MaterialId>& material);

}  // namespace diurna
