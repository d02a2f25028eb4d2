#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "materials/matter/library.hpp"
#include "scenes/plan/prepared.hpp"
#include "terrain/facets.hpp"

/// What a page reports the temperatures of: facets under a name.
namespace diurna {

struct FacetGroup {
    std::string name;
    std::vector<std::uint32_t> facet;  // of world.surfaces(), ascending
};

/// One for each material that has facets, by name; levels of its textures and both sides of its
/// sheets count with it.
std::vector<FacetGroup> material_groups(const FacetSet& facets, const MaterialLibrary& materials);

/// One for the ground and each polygon, building and object that has facets of its own, in the
/// scene's order. Copies of an object have its temperatures and no facets.
std::vector<FacetGroup> object_groups(const Prepared& prepared);

/// The parts of a building or an object: its facets by material, of a target by part.
struct ObjectParts {
    std::string object;
    std::vector<FacetGroup> part;
};
/// Of those that have several, in the scene's order.
std::vector<ObjectParts> part_groups(const Prepared& prepared);

}  // namespace diurna
