#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "materials/matter/library.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "terrain/facets.hpp"

/// Groups of facets whose temperatures a page shows.
namespace diurna {

struct FacetGroup {
    std::string name;
    std::vector<std::uint32_t> facet;  // of world.surfaces(), ascending
};

/// One for each material that has facets, by name; levels of its textures and both sides of its
/// sheets are included.
std::vector<FacetGroup> material_groups(const FacetSet& facets, const MaterialLibrary& materials);

/// One for the ground and each polygon, building and object with its own facets, in the scene's
/// order. Copies that share an object's temperatures have none.
std::vector<FacetGroup> object_groups(const Prepared& prepared);

/// The parts of a building or an object: its facets by material, of a target by part.
struct ObjectParts {
    std::string object;
    std::vector<FacetGroup> part;
};
/// For those with several parts, in the scene's order.
std::vector<ObjectParts> part_groups(const Prepared& prepared);

}  // namespace diurna
