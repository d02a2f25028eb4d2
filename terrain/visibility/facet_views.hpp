#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Facet-to-facet view factors in compressed rows: facet f sees facet[k] with factor[k] for k in
/// [row[f], row[f+1]). A row sums to 1 − sky(f) (− what falls below the terrain's edge).
struct ViewFactors {
    std::vector<std::uint32_t> row;  // size() + 1
    std::vector<FacetId> facet;
    std::vector<float> factor;
};

/// What each facet sees through its own hemisphere, cosine-weighted about its own normal.
/// `sky` + Σ row of `others` + `below` = 1, where `below` is what leaves the scene's edge under
/// the horizontal: far ground not modelled, to be taken as ground like the facet's own
/// surroundings.
struct FacetViews {
    std::vector<float> sky;    // 0 to 1: the sky view factor
    std::vector<float> below;  // 0 to 1
    ViewFactors others;
    std::vector<std::uint16_t> rays = {};  // (facet) that this comes from; empty: as many of each
};

struct FacetViewOptions {
    int rays = 64;  // stratified, cosine-weighted directions per facet, 1 to 65535
    /// Facets from this one on take so many instead. What a wall sees differs more from place to
    /// place than what open ground does, and thin metal follows every error.
    std::size_t first_object = std::numeric_limits<std::size_t>::max();
    int object_rays = 256;
    std::uint64_t seed = 1;
    bool others = true;  // or leave their rows empty
};

/// By rays from points spread over each facet. Standard error of a facet about
/// 0.65/rays^0.75 (0.03 at 64 rays, 0.011 at 256, measured in bowls), of means over n facets √n
/// less; the same numbers for any number of threads. Rays above everything near (SkyBound) are not
/// traced, the others asked whether anything blocks them, and those that are blocked, what.
FacetViews facet_views(const FacetSet& facets, const RayScene& scene,
                       const FacetViewOptions& options = {});

struct SunFractionOptions {
    int samples = 4;  // points over the facet × directions over the sun's disc, stratified together
    std::uint64_t seed = 1;
};

/// The share of each facet (area × sun's disc) that the sun at `direction` (unit, towards the sun)
/// reaches, 0 to 1, self-shading by the facet's own orientation included: zero where
/// normal·direction ≤ 0. `fraction` has facets.size() entries. For a sun below the horizon all are
/// zero.
void sun_fraction(const FacetSet& facets, const RayScene& scene, const Eigen::Vector3d& direction,
                  std::span<float> fraction, const SunFractionOptions& options = {});

/// The same for the chosen facets alone (1: chosen); the others keep what they have.
void sun_fraction(const FacetSet& facets, const RayScene& scene, const Eigen::Vector3d& direction,
                  std::span<const std::uint8_t> chosen, std::span<float> fraction,
                  const SunFractionOptions& options = {});

}  // namespace diurna
