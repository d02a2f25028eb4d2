#pragma once

#include <vector>

#include "scenes/input/scene.hpp"
#include "scenes/world/objects.hpp"
#include "scenes/world/world.hpp"
#include "thermal/solve/network_object.hpp"

namespace diurna {

/// Ground that shall be fine where the jets of an object that stands meet it: squares round the
/// stagnation point.
///
/// - over_ground: height of its lowest point over the ground at its place [m]
std::vector<GroundPatch> jet_patches(const ObjectInput& object, double over_ground);

/// Finds what the jets of targets blow over (thermal/surface/hot_jet.hpp): faces of their own, of
/// other targets, and of what is neither: ground and plain objects of plain layers, which become
/// columns of the jet's target. What lies between keeps it off. Each face has the mean over places
/// on it no further apart than half a diameter, or a tenth of their distance. All faces together
/// get no more than the jet has. What is not followed is reported in the targets' notes.
///
/// all  (target of the world) whose jets have no faces yet
void blow(const World& world, const Scene& scene, std::vector<NetworkObject>& all);

}  // namespace diurna
