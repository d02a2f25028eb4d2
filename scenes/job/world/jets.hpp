#pragma once

#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/objects.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/solve/network_object.hpp"

namespace diurna {

/// Refined ground where the jets of an object at rest meet it: squares around the stagnation
/// point.
///
/// - over_ground: height of its lowest point over the ground at its place [m]
std::vector<GroundPatch> jet_patches(const ObjectInput& object, double over_ground);

/// Finds the faces in the jets of targets (thermal/surface/hot_jet.hpp): their own, those of other
/// targets, and others: ground and plain objects of plain layers, which become columns of the jet's
/// target. Obstacles in between block the jet. Each face has the mean over points on it at most
/// half a diameter apart, or a tenth of their distance. All faces together receive at most the
/// jet's heat. Parts that are not modelled are reported in the targets' notes.
///
/// all  (target of the world) whose jets have no faces yet
void blow(const World& world, const Scene& scene, std::vector<NetworkObject>& all);

}  // namespace diurna
