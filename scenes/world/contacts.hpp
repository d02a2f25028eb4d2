#pragma once

#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/world/world.hpp"
#include "thermal/solve/network_object.hpp"

namespace diurna {

/// Joins the parts of a target that lie on one another, or on the ground, as its [[contact]] tables
/// say (scenes/input/read_contact.hpp): the ground's facets below become columns of its network.
/// Throws InputError where nothing touches, or where that ground is no plain column.
///
/// part     (network's facet) of the target's tables, −1 for none
/// taken    (facet of the scene) that a target has; what this one touches is added
void join_contacts(const World& world, const Scene& scene, const ObjectInput& input,
                   const std::vector<int>& part, NetworkObject& object, std::vector<bool>& taken);

}  // namespace diurna
