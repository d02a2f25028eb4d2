#pragma once

#include <Eigen/Core>
#include <vector>

#include "terrain/objects/mesh_file.hpp"
#include "terrain/objects/object_mesh.hpp"

namespace diurna {

/// Which way is up in a file; its front looks along +z where y is up (glTF), along +y where z is.
enum class UpAxis { y, z };

/// How a mesh stands in the scene.
struct Placing {
    Eigen::Vector3d base = Eigen::Vector3d::Zero();  // its middle in plan and its lowest point [m]
    double heading_deg = 0.0;                        // the way its front looks, from north
    UpAxis up = UpAxis::y;
    double metres = 1.0;                     // per unit of the file
    double largest_edge = 0.5;               // longer edges are cut [m]
    double pitch_deg = 0.0, roll_deg = 0.0;  // its front above, its right side below the level
};

/// From a file's axes, origin and unit to those of an object: right, front, up [m], from its middle
/// in plan and its lowest point.
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

/// The mesh turned, scaled and put down, its long edges halved until none is longer than
/// `largest_edge`: neighbours share the new vertices, so that no crack opens.
///
/// material  (part of the file)
ObjectMesh placed_mesh(const MeshFile& mesh, const Placing& placing,
                       const std::vector<MaterialId>& material);

}  // namespace diurna
