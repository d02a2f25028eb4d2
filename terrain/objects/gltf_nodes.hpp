#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "terrain/objects/gltf_accessors.hpp"

namespace diurna {

/// A mesh of a glTF where a node, or an instance of one, puts it.
struct GltfPlacing {
    std::size_t mesh;
    std::size_t node;
    Eigen::Affine3d transform;           // to the scene's axes
    std::vector<Eigen::Affine3d> joint;  // of its skin, in place of `transform`; empty: it has none
};

/// What the nodes of the file's scene place, nodes below others included, one for each instance of
/// EXT_mesh_gpu_instancing; joints of skins where the file's nodes are, animations aside. Without
/// `scene` it is the first; without scenes every node that is no child.
///
/// Throws InputError where nodes are no trees: one that is below itself, a child twice, too deep;
/// where one is of no such mesh, or placed by other than numbers.
std::vector<GltfPlacing> gltf_placings(const Gltf& gltf, GltfAccessors& accessors);

}  // namespace diurna
