#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "terrain/objects/gltf_accessors.hpp"

namespace diurna {

/// A mesh of a glTF with the position given by a node, or by an instance of one.
struct GltfPlacing {
    std::size_t mesh;
    std::size_t node;
    Eigen::Affine3d transform;           // to the scene's axes
    std::vector<Eigen::Affine3d> joint;  // of its skin, replacing `transform`; empty: it has none
};

/// The meshes placed by the nodes of the file's scene, child nodes included, one for each instance
/// of EXT_mesh_gpu_instancing; joints of skins at the file's node positions, without animation.
/// Without `scene` the first scene is used; without scenes every node that is no child.
///
/// Throws InputError if nodes do not form trees (a node below itself, a child of two, too deep), if
/// a node refers to no such mesh, or if its position is not given by numbers.
std::vector<GltfPlacing> gltf_placings(const Gltf& gltf, GltfAccessors& accessors);

}  // namespace diurna
