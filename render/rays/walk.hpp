#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "materials/matter/library.hpp"
#include "render/rays/hops.hpp"
#include "render/rays/plume.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Uniform in [0, 1): depends on the given numbers alone (SplitMix64's finaliser).
struct Chance {
    std::uint64_t state;
    double operator()() {
        state += 0x9E3779B97F4A7C15u;
        std::uint64_t x = state;
        x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
        x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
        return static_cast<double>((x ^ (x >> 31)) >> 11) * 0x1p-53;
    }
};

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
          float weight, Chance& chance, std::vector<Hop>& out);

}  // namespace diurna
