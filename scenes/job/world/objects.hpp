#pragma once

#include <Eigen/Core>
#include <vector>

#include "materials/matter/library.hpp"
#include "scenes/job/input/read_object.hpp"
#include "terrain/objects/object_mesh.hpp"
#include "terrain/objects/placed_mesh.hpp"

/// Meshes from files on the ground of a scene.
namespace diurna {

/// Each part of a target has its own material, "NAME of OBJECT: PART", which identifies its
/// facets.
std::string part_material_name(const ObjectInput& object, std::size_t part);

/// Its triangles, in its placing (scenes/job/world/stance.hpp). For one in flight the materials
/// are copies with its speed and length, added to the library; for a target, copies for its
/// parts.
ObjectMesh object_mesh(const ObjectInput& object, MaterialLibrary& materials);

/// From its lowest to its highest point [m].
double object_height(const ObjectInput& object);

/// The second largest of its three sizes [m]: about the width of its shadow.
double object_breadth(const ObjectInput& object);

/// Length of its shadow from its middle at a sun elevation of 27 degrees [m].
double shadow_reach(const ObjectInput& object);

/// Refined ground around an object for its shadow: a square as large as the shadow at a sun
/// elevation of 27 degrees, about 24 triangle edges across, or with the object's edge length.
struct GroundPatch {
    std::vector<Eigen::Vector2d> ring;  // east, north [m]
    double largest_edge;                // [m]
};
GroundPatch ground_patch(const ObjectInput& object, const Eigen::Vector2d& place);

}  // namespace diurna
