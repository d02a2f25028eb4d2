#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

struct SunFractionOptions {
    int samples = 4;  // points over the facet × directions over the sun's disc, stratified together
    /// Additional samples for facets that a shadow's edge crosses or may cross: the samples, or
    /// those of a chosen facet with a common corner, do not all agree. Four samples give such a
    /// facet's share to 0.15, sixteen to 0.05. 0: none.
    int edge_samples = 0;
    std::uint64_t seed = 1;
    float time = 0.5f;  // in a scene with motion: time of the shadows
};

/// The share of each facet (area × sun's disc) that the sun at `direction` (unit, towards
/// the sun) reaches, 0 to 1, including self-shading by the facet's orientation: zero if
/// normal·direction ≤ 0. Transparent facets (RayScene) attenuate the beam and cast no
/// full shadow. `fraction` has facets.size() entries. All are zero for a sun below the
/// horizon.
void sun_fraction(const FacetSet& facets, const RayScene& scene, const Eigen::Vector3d& direction,
                  std::span<float> fraction, const SunFractionOptions& options = {});

/// The same for the chosen facets only; the others are unchanged.
void sun_fraction(const FacetSet& facets, const RayScene& scene, const Eigen::Vector3d& direction,
                  std::span<const std::uint32_t> chosen, std::span<float> fraction,
                  const SunFractionOptions& options = {});

}  // namespace diurna
