#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "materials/base/random.hpp"
#include "materials/matter/library.hpp"
#include "render/rays/plume.hpp"
#include "render/rays/secondary_rays.hpp"
#include "render/view/textured_hit.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// The scene as rays meet it.
struct SecondaryScene {
    const RayScene& rays;
    const FacetSet& facets;
    const MaterialLibrary& materials;
    const PlumeScene& plumes;
    const TexturedHit* textured = nullptr;  // null: no textures
    double wind_speed = 3.0;                // [m s⁻¹] over water (materials/matter/waves.hpp)

    const Material& material(FacetId facet) const {
        return materials[facets.material[index(facet)]];
    }
    bool needs_rays(FacetId facet) const { return material(facet).needs_rays(); }
};

/// Where in the lobe of the first rough mirror a ray goes on.
struct LobeRays {
    int count = 1;  // that share its weight
    /// Of the first in the lobe's u and v, and from one to the next, modulo 1. Negative: by chance.
    std::array<double, 2> first = {-1.0, -1.0}, step = {0.0, 0.0};
};

/// A ray from the eye.
struct EyeRay {
    Eigen::Vector3d origin, direction;
    float weight = 1.0f;  // share of the pixel
    LobeRays lobe{};
};

/// Follows one ray to its ends and adds what it meets to `out`, a secondary ray before those behind
/// it, each with its weight. Behind panes and nets it goes on, up to 8 times. A mirror sends one
/// ray (the first rough one `lobe.count`) into its lobe, twice at most, with the weight of the
/// microfacet that it meets (microfacet.hpp) but for Fresnel's factor; off a rough one into the sky
/// it is left out, as the lobe's sum has it (rough_mirror.hpp). What is met after that is closed:
/// it mirrors as if diffuse and shows its own temperature. A textured facet where a ray ends is two
/// secondary rays that share the weight; one that lets rays go on is one of its two surfaces by
/// chance.
void walk(const SecondaryScene& scene, const EyeRay& ray, RandomStream& chance,
          std::vector<SecondaryRay>& out);

}  // namespace diurna
