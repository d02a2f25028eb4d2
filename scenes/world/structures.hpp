#pragma once

#include <span>
#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/world/ground_cuts.hpp"
#include "scenes/world/land.hpp"
#include "scenes/world/sheets.hpp"
#include "scenes/world/world.hpp"
#include "terrain/objects/box.hpp"
#include "terrain/objects/object_mesh.hpp"

/// What stands on the ground of a scene: each an object of its own among the world's facets.
namespace diurna {

/// The buildings of the scene file; each stands with its corners in the ground.
std::vector<BoxSpec> box_specs(const Scene& scene, const Dem& dem, const Site& site);
/// What stands on the ground with walls: boxes, then buildings of files.
std::vector<WalledPlan> walled_plans(const std::vector<BoxSpec>& boxes,
                                     const std::vector<ShapeBuilding>& shapes);

void append_buildings(World& world, const Scene& scene, const std::vector<BoxSpec>& boxes);
/// Meshes of files, but for copies (copied_objects.hpp); the materials of open ones are added to
/// the scene's.
void append_objects(World& world, Scene& scene, const Dem& dem, Sheets& sheets);
/// One of them, whose placing then says where it stands and how it is turned.
///
/// - object: its place among the scene's
void append_object(World& world, Scene& scene, const Dem& dem, Sheets& sheets, std::size_t object);
/// By which its facets are known.
ObjectId object_id(const Scene& scene, std::size_t object);
/// Throws InputError where all of an object is below the ground: nothing would be seen of it.
void refuse_buried(const ObjectInput& object, std::span<const Eigen::Vector3f> vertex,
                   const Dem& dem, const Site& site);
/// Footprints of files, one object per file.
void append_shape_buildings(World& world, const Scene& scene, std::vector<ShapeBuilding> buildings);

}  // namespace diurna
