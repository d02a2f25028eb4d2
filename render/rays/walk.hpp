#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "materials/base/random.hpp"
#include "materials/matter/library.hpp"
#include "render/rays/hops.hpp"
#include "render/rays/plume.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// The scene as rays meet it.
struct HopScene {
    const RayScene& scene;
    const FacetSet& facets;
    const MaterialLibrary& materials;
    const PlumeScene& plumes;
    const Observer& observer;
    const TextureLevels* texture_levels = nullptr;  // null: no textures
    double sample_angle = 0.0;                      // of the observer's samples (view.hpp)
};

/// Follows one ray to its ends and adds what it meets to `out`, a hop before those behind it, each
/// with the given weight. Behind panes and nets it goes on, up to 8 times; a mirror sends one ray
/// into its lobe, twice at most. What is met after that is closed. A textured facet where a ray
/// ends is two hops that share the weight; one that lets rays go on is one of its two surfaces by
/// chance.
void walk(const HopScene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
          float weight, RandomStream& chance, std::vector<Hop>& out);

}  // namespace diurna
