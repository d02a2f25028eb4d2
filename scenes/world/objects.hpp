#pragma once

#include <Eigen/Core>
#include <vector>

#include "materials/matter/library.hpp"
#include "scenes/input/read_object.hpp"
#include "terrain/objects/object_mesh.hpp"
#include "terrain/objects/placed_mesh.hpp"

/// Meshes of files on the ground of a scene.
namespace diurna {

/// Of objects that are targets each part has a material of its own, "NAME of OBJECT: PART", by
/// which its facets are known.
std::string part_material_name(const ObjectInput& object, std::size_t part);

/// Its triangles, as its placing says (scenes/world/stance.hpp). Of one in flight the
/// materials are copies that know its speed and length, added to the library; so are those of the
/// parts of a target.
ObjectMesh object_mesh(const ObjectInput& object, MaterialLibrary& materials);

/// From its lowest to its highest point [m].
double object_height(const ObjectInput& object);

/// The second largest of its three sizes [m]: about the breadth of its shadow.
double object_breadth(const ObjectInput& object);

/// How far a sun 27 degrees high casts its shadow from its middle [m].
double shadow_reach(const ObjectInput& object);

/// Ground around an object that shall be fine enough for its shadow: a square as far as a sun 27
/// degrees high casts it, about 24 triangles' edges across, or of edges as the object says.
struct GroundPatch {
    std::vector<Eigen::Vector2d> ring;  // east, north [m]
    double largest_edge;                // [m]
};
GroundPatch ground_patch(const ObjectInput& object, const Eigen::Vector2d& place);

/// Ground round walls: rings at twice the distance each, as far as a sun 27 degrees high casts
/// their shadow, divided to half their distance; the first, and the walls' own plan, to `nearest`.
std::vector<GroundPatch> rings_round(const std::vector<Eigen::Vector2d>& plan, double height,
                                     double nearest);

}  // namespace diurna
