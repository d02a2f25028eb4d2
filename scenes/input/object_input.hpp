#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scenes/input/read_height.hpp"
#include "scenes/input/target_input.hpp"
#include "terrain/objects/mesh_file.hpp"
#include "terrain/objects/placed_mesh.hpp"

namespace diurna {

/// A vehicle, a shed, a panel: a mesh of a file, or one of the program's own models, that a scene
/// puts on its ground.
struct ObjectInput {
    std::string name;
    std::string kind;            // its class in labels
    std::filesystem::path file;  // of its mesh; "": a model, built by the program
    std::shared_ptr<MeshFile> mesh = std::make_shared<MeshFile>();  // of all copies
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  // of its middle in plan; east, north [m]
    Placing placing;                                  // its base is found on the ground
    HeightInput stands;                               // of its lowest point
    bool on_slope = false;       // lies on the ground as that slopes; false: plumb or as reported
    bool at_any_height = false;  // however far from the ground it is
    bool angles_given = false;   // its pitch and roll are those of its placing
    std::vector<Eigen::Vector3d> contact;  // where it touches the ground, in its own frame [m]
    std::string trajectory;                // that it goes: its place and height
    double ground_edge = 0.0;              // [m] of the ground round it; 0: by its size
    double airspeed = 0.0;                 // [m s⁻¹] along its heading; 0: it stands
    std::vector<std::string> material;     // (part of the mesh)
    TargetInput target;                    // as one body of heat
    std::vector<std::string> notes;        // on the mesh: what was skipped of it
    std::string where;                     // its height or place in the scene file
    std::string copy_of;                   // the name that copies have in common; "": none
    std::filesystem::path copies_file;     // where their places stand; "": in the scene
    double alike_within = 0.0;  // [K] copies that share temperatures; 0: each has its own
};

}  // namespace diurna
