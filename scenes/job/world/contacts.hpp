#pragma once

#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/solve/network_object.hpp"

namespace diurna {

/// Joins the parts of a target that touch one another, or the ground, as given in its [[contact]]
/// tables (scenes/job/input/read_contact.hpp): the ground's facets below become columns of its
/// network. Throws InputError if nothing touches, or if that ground has no plain column.
///
/// part     (network's facet) of the target's tables, −1 for none
/// taken    (facet of the scene) in use by a target; facets touched by this one are added
void join_contacts(const World& world, const Scene& scene, const ObjectInput& input,
                   const std::vector<int>& part, NetworkObject& object, std::vector<bool>& taken);

}  // namespace diurna
