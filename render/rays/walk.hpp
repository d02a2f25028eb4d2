#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "materials/base/random.hpp"
#include "materials/matter/library.hpp"
#include "render/rays/hops.hpp"
#include "render/rays/plume.hpp"
#include "render/view/textured_hit.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// The scene as rays meet it.
struct HopScene {
    const RayScene& rays;
    const FacetSet& facets;
    const MaterialLibrary& materials;
    const PlumeScene& plumes;
    const TexturedHit* textured = nullptr;  // null: no textures

    const Material& material(FacetId facet) const {
        return materials[facets.material[index(facet)]];
    }
    bool needs_rays(FacetId facet) const { return material(facet).needs_rays(); }
};

/// Follows one ray to its ends and adds what it meets to `out`, a hop before those behind it, each
/// with the given weight. Behind panes and nets it goes on, up to 8 times. A mirror sends one ray
/// into its lobe (the best of four of the visible microfacets, picked by weight), twice at most.
/// What is met after that is closed: it mirrors as if diffuse and shows its own temperature. A
/// textured facet where a ray ends is two hops that share the weight; one that lets rays go on is
/// one of its two surfaces by chance.
void walk(const HopScene& scene, const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
          float weight, RandomStream& chance, std::vector<Hop>& out);

}  // namespace diurna
