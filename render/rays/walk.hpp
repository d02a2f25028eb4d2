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

/// The scene for tracing secondary rays.
struct SecondaryScene {
    const RayScene& rays;
    const FacetSet& facets;
    const MaterialLibrary& materials;
    const PlumeScene& plumes;
    const TexturedHit* textured = nullptr;  // null: no textures
    double wind_speed = 3.0;                // [m s⁻¹] over water (materials/matter/waves.hpp)

    const Material& material(SurfaceId surface) const {
        return materials[facets.material[index(surface)]];
    }
    bool needs_rays(SurfaceId surface) const { return material(surface).needs_rays(); }
};

/// Rays in the lobe of the first rough mirror.
struct LobeRays {
    int count = 1;  // number that share its weight
    /// Of the first in the lobe's u and v, and increment, modulo 1. Negative: random.
    std::array<double, 2> first = {-1.0, -1.0}, step = {0.0, 0.0};
};

/// A ray from the eye.
struct EyeRay {
    Eigen::Vector3d origin, direction;
    float weight = 1.0f;  // share of the pixel
    LobeRays lobe{};
};

/// Follows one ray to its ends and adds its hits to `out`, a secondary ray before those
/// behind it, each with its weight. Behind panes and nets it continues, up to 8 times.
/// A mirror sends one ray (the first rough one `lobe.count`) into its lobe, at most
/// twice, with the microfacet's weight (microfacet.hpp) without Fresnel's factor; a ray
/// from a rough one into the sky is omitted, as in the lobe integral
/// (rough_mirror.hpp). Hits after that are closed: they reflect as if diffuse and
/// transmit their own temperature. A textured facet at the end of a ray becomes two
/// secondary rays that share the weight; if rays continue behind it, one of its two
/// surfaces at random.
///
/// - returns the number of rays traced, the eye's included
std::uint32_t walk(const SecondaryScene& scene, const EyeRay& ray, RandomStream& chance,
                   std::vector<SecondaryRay>& out);

}  // namespace diurna
