#pragma once

#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/world/world.hpp"
#include "thermal/solve/network_object.hpp"

/// Objects as bodies of heat.
namespace diurna {

/// Which materials of an object's facets are which of its mesh's parts. Throws InputError where
/// one is beyond a network: leaves, water that freezes or melts, snow.
///
/// object  index into the scene's
TargetFacets target_facets(const ObjectInput& input, std::size_t object, ObjectId id,
                           const MaterialLibrary& materials);

/// The networks of all targets over world.surfaces(): their facets joined over common edges, their
/// enclosures, lumps and sources.
std::vector<NetworkObject> targets(const World& world, const Scene& scene);

}  // namespace diurna
