#pragma once

#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/solve/network_object.hpp"

/// Objects as thermal networks.
namespace diurna {

/// Materials of an object's facets by part of its mesh. Throws InputError for parts that a network
/// does not support: leaves, water that freezes or melts, snow.
///
/// object  index into the scene's
TargetFacets target_facets(const ObjectInput& input, std::size_t object, ObjectId id,
                           const MaterialLibrary& materials);

/// The networks of all targets over world.surfaces(): their facets joined over common edges, their
/// enclosures, lumps and sources.
std::vector<NetworkObject> targets(const World& world, const Scene& scene);

}  // namespace diurna
