#pragma once

#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"

/// Surface variations: textures on a scene's ground, buildings, objects and
/// materials.
namespace diurna {

/// Assigns to every textured facet of the world its levels' materials, which are added to the
/// scene's, and its copies: World::texture_levels. A texture on an object takes precedence over one
/// on its material. Throws InputError for a texture that does not fit a material: a deviation too
/// wide for its albedo, a picture that covers nothing.
///
/// returns  notes for the report: number of facets, number of solutions
std::vector<std::string> lay_textures(Scene& scene, World& world);

}  // namespace diurna
