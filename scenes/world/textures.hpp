#pragma once

#include <string>
#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/world/world.hpp"

/// Surfaces that vary from place to place: textures that a scene lays on its ground, buildings,
/// objects and materials.
namespace diurna {

/// Gives every textured facet of the world its levels' materials, which are added to the scene's,
/// and its copies: World::texture_levels. What lies on an object goes before what lies on its
/// material. Throws InputError for a texture that a material cannot bear: a deviation too wide for
/// its albedo, a picture that is nowhere.
///
/// returns  notes for the report: how many facets, solved how often
std::vector<std::string> lay_textures(Scene& scene, World& world);

}  // namespace diurna
