#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scenes/job/input/read_height.hpp"
#include "scenes/job/input/target_input.hpp"
#include "terrain/objects/mesh_file.hpp"
#include "terrain/objects/placed_mesh.hpp"

namespace diurna {

/// A vehicle, a shed, a panel: a mesh from a file, or one of the built-in models, placed on a
/// scene's ground.
struct ObjectInput {
    std::string name;
    std::string kind;            // its class in labels
    std::filesystem::path file;  // of its mesh; "": a built-in model
    std::shared_ptr<MeshFile> mesh = std::make_shared<MeshFile>();  // shared by all copies
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  // of its middle in plan; east, north [m]
    Placing placing;                                  // its base is computed from the ground
    HeightInput stands;                               // of its base: of its lowest point if level
    bool on_slope = false;                 // tilted with the ground; false: vertical or as given
    bool at_any_height = false;            // at any distance from the ground
    bool angles_given = false;             // its pitch and roll are given in its placing
    std::vector<Eigen::Vector3d> contact;  // contact points with the ground, in its own frame [m]
    std::string trajectory;                // that it follows: its place and height
    double ground_edge = 0.0;              // [m] of the ground around it; 0: by its size
    double finer_edges = 1.0;              // that edge is divided by it
    double airspeed = 0.0;                 // [m s⁻¹] along its heading; 0: at rest
    std::vector<std::string> material;     // (part of the mesh)
    TargetInput target;                    // as one thermal network
    std::vector<std::string> notes;        // on the mesh: what was skipped
    std::string where;                     // position of its height or place in the scene file
    std::string copy_of;                   // common name of copies; "": none
    std::filesystem::path copies_file;     // file of their places; "": in the scene
    double alike_within = 0.0;  // [K] for copies that share temperatures; 0: each has its own
};

}  // namespace diurna
