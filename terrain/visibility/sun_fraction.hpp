#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

struct SunFractionOptions {
    int samples = 4;  // points over the facet × directions over the sun's disc, stratified together
    /// As many more for facets that an edge of a shadow crosses or may cross: the samples, or those
    /// of a chosen facet that has a corner in common, do not all agree. Four samples tell such a
    /// facet's share to 0.15, sixteen to 0.05. 0: none.
    int edge_samples = 0;
    std::uint64_t seed = 1;
    float time = 0.5f;  // in a scene that moves: what casts shadows is where it is then
};

/// The share of each facet (area × sun's disc) that the sun at `direction` (unit, towards the sun)
/// reaches, 0 to 1, self-shading by the facet's own orientation included: zero where
/// normal·direction ≤ 0. What lets the beam through (RayScene) dims it and casts no shadow.
/// `fraction` has facets.size() entries. For a sun below the horizon all are
/// zero.
void sun_fraction(const FacetSet& facets, const RayScene& scene, const Eigen::Vector3d& direction,
                  std::span<float> fraction, const SunFractionOptions& options = {});

/// The same for the chosen facets alone; the others keep what they have.
void sun_fraction(const FacetSet& facets, const RayScene& scene, const Eigen::Vector3d& direction,
                  std::span<const std::uint32_t> chosen, std::span<float> fraction,
                  const SunFractionOptions& options = {});

}  // namespace diurna
