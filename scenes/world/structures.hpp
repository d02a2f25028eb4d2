#pragma once

#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/world/land.hpp"
#include "scenes/world/world.hpp"
#include "terrain/objects/box.hpp"
#include "terrain/objects/object_mesh.hpp"

/// What stands on the ground of a scene: each an object of its own among the world's facets.
namespace diurna {

/// The buildings of the scene file; each stands with its corners in the ground.
std::vector<BoxSpec> box_specs(const Scene& scene, const Dem& dem, const Site& site);
/// Corners of a box's plan; east, north [m].
std::vector<Eigen::Vector2d> plan_of(const BoxSpec& spec);

void append_buildings(World& world, const Scene& scene, const std::vector<BoxSpec>& boxes);
void append_objects(World& world, const Scene& scene, const Dem& dem);
/// Footprints of files, one object per file.
void append_shape_buildings(World& world, const Scene& scene, std::vector<ShapeBuilding> buildings);

}  // namespace diurna
