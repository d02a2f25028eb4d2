#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "terrain/objects/gltf_accessors.hpp"

namespace diurna {

/// What a primitive of a glTF's mesh draws, in the mesh's own axes.
struct GltfPrimitive {
    std::vector<Eigen::Vector3d> place;  // those alone that triangles use
    std::vector<std::array<std::uint32_t, 3>> triangle;
    std::string material;        // its name; may be empty
    double largest_float = 0.0;  // of coordinates that are of 32 bits, the largest absolute value
    bool drawn = true;           // false: points or lines

    struct Pull {
        std::uint32_t joint;
        double share;
    };
    std::size_t pulls = 0;   // of each place; 0: it hangs on no joints
    std::vector<Pull> pull;  // (place, pulls)
};

/// The primitives of a mesh: triangles, strips and fans, by their indices or without, moved by its
/// morph targets.
///
/// - weights: of the morph targets; empty: the mesh's own
///
/// Throws InputError for an index past the last vertex, fewer indices than the mode needs, a mode
/// that is none, positions that are no numbers of a kind that the file may use, or that are packed.
std::vector<GltfPrimitive> gltf_primitives(const Gltf& gltf, GltfAccessors& accessors,
                                           std::size_t mesh, std::vector<double> weights);

/// Weights of morph targets of a mesh or a node; empty: it has none.
std::vector<double> gltf_weights(const Gltf& gltf, const nlohmann::json& of,
                                 const std::string& where);

}  // namespace diurna
