#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/matter/library.hpp"
#include "terrain/objects/placed_mesh.hpp"

/// Vehicles, sheds, panels: meshes of files that a scene puts on its ground.
namespace diurna {

class Section;

struct ObjectInput {
    std::string name;
    std::filesystem::path file;
    MeshFile mesh;
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  // of its middle in plan; east, north [m]
    Placing placing;                                  // its base is found on the ground
    double height_above_ground = 0.0;                 // of its lowest point [m]
    std::vector<std::string> material;                // (part of the mesh)
};

/// The keys of [[object]] but its name; mistakes are noted in the section.
ObjectInput read_object_input(const Section& section, const std::filesystem::path& folder,
                              const std::vector<std::string>& materials);

/// Its triangles, its lowest point `height_above_ground` over the ground at its place.
ObjectMesh object_mesh(const ObjectInput& object, const Eigen::Vector3d& ground,
                       const MaterialLibrary& materials);

/// Ground around an object that shall be fine enough for its shadow: a square as far as a sun 27
/// degrees high casts it, about 24 triangles' edges across.
struct GroundPatch {
    std::vector<Eigen::Vector2d> ring;  // east, north [m]
    double largest_edge;                // [m]
};
GroundPatch ground_patch(const ObjectInput& object);

}  // namespace diurna
