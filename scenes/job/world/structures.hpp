#pragma once

#include <span>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/ground_cuts.hpp"
#include "scenes/job/world/land.hpp"
#include "scenes/job/world/sheets.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/objects/box.hpp"
#include "terrain/objects/object_mesh.hpp"

/// Buildings and objects on the ground of a scene: each a separate object in the world's facets.
namespace diurna {

/// The buildings of the scene file; the corners of each are in the ground.
std::vector<BoxSpec> box_specs(const Scene& scene, const Dem& dem, const Site& site);
/// Buildings with walls: boxes, then buildings from files.
std::vector<WalledPlan> walled_plans(const std::vector<BoxSpec>& boxes,
                                     const std::vector<ShapeBuilding>& shapes);

void append_buildings(World& world, const Scene& scene, const std::vector<BoxSpec>& boxes);
/// Meshes from files, except copies (copied_objects.hpp); the materials of open ones are added to
/// the scene's.
void append_objects(World& world, Scene& scene, const Dem& dem, Sheets& sheets);
/// One of them; its position and attitude are stored in its placing.
///
/// - object: its index in the scene
void append_object(World& world, Scene& scene, const Dem& dem, Sheets& sheets, std::size_t object);
/// Identifies its facets.
ObjectId object_id(const Scene& scene, std::size_t object);
/// Throws InputError if an object is entirely below the ground and so invisible.
void refuse_buried(const ObjectInput& object, std::span<const Eigen::Vector3f> vertex,
                   const Dem& dem, const Site& site);
/// Building footprints from files, one object per file.
void append_shape_buildings(World& world, const Scene& scene, std::vector<ShapeBuilding> buildings);

}  // namespace diurna
