#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/input/checked_names.hpp"
#include "scenes/input/read_target.hpp"
#include "terrain/objects/mesh_file.hpp"
#include "terrain/objects/placed_mesh.hpp"

/// Vehicles, sheds, panels: meshes of files, or of the program's own models, that a scene puts on
/// its ground.
namespace diurna {

struct ObjectInput {
    std::string name;
    std::string kind;            // its class in labels
    std::filesystem::path file;  // of its mesh; "": a model, built by the program
    MeshFile mesh;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  // of its middle in plan; east, north [m]
    Placing placing;                                  // its base is found on the ground
    double height_above_ground = 0.0;                 // of its lowest point [m]
    std::string trajectory;                           // that it goes: its place and height
    double airspeed = 0.0;                            // [m s⁻¹] along its heading; 0: it stands
    std::vector<std::string> material;                // (part of the mesh)
    TargetInput target;                               // as one body of heat
    std::vector<std::string> notes;                   // on the mesh: what was left out of it
    std::string where;                                // height_above_ground_m in the scene file
};

/// One table [[object]].
ObjectInput read_object(const Section& section, Reading& reading);

}  // namespace diurna
