#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "terrain/objects/gltf_accessors.hpp"

namespace diurna {

/// The triangles of a primitive of a glTF mesh, in the mesh's own axes.
struct GltfPrimitive {
    std::vector<Eigen::Vector3d> place;  // only vertices used by triangles
    std::vector<std::array<std::uint32_t, 3>> triangle;
    std::string material;        // its name; may be empty
    double largest_float = 0.0;  // largest absolute value of 32-bit coordinates
    bool drawn = true;           // false: points or lines

    struct Pull {
        std::uint32_t joint;
        double share;
    };
    std::size_t pulls = 0;   // per vertex; 0: not attached to joints
    std::vector<Pull> pull;  // (place, pulls)
};

/// The primitives of a mesh: triangles, strips and fans, with or without indices, deformed by its
/// morph targets.
///
/// - weights: of the morph targets; empty: the mesh's own
///
/// Throws InputError for an index past the last vertex, fewer indices than the mode needs, an
/// unknown mode, positions of a type that is not allowed, or compressed positions.
std::vector<GltfPrimitive> gltf_primitives(const Gltf& gltf, GltfAccessors& accessors,
                                           std::size_t mesh, std::vector<double> weights);

/// Weights of morph targets of a mesh or a node; empty: it has none.
std::vector<double> gltf_weights(const Gltf& gltf, const nlohmann::json& of,
                                 const std::string& where);

}  // namespace diurna
