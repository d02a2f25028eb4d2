#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

struct FacetViewOptions {
    int rays = 64;  // stratified, cosine-weighted directions per facet, 1 to 65535
    /// Facets before this one are ground, a height field; from it on they take so many rays
    /// instead. What a wall sees differs more from place to place than what open ground does, and
    /// thin metal follows every error.
    std::size_t first_object = std::numeric_limits<std::size_t>::max();
    int object_rays = 256;
    /// (ground facet) 1 where something may be seen that is no ground: `rays` find how much that is
    /// and the less, the more others are taken, 2 to 32 times as many: what a vehicle hides ten
    /// metres away is 1 % of the sky, and 64 rays meet it once or not at all, which is 0.1 K
    /// between neighbours at night. Empty: nowhere.
    std::span<const std::uint8_t> near_objects{};
    std::uint64_t seed = 1;
    bool others = true;     // or leave their rows empty
    bool sunlight = false;  // of what goes through facets, that of the sun's spectrum; else of heat
};

/// Rays go on through what lets light pass (RayScene), which counts for what it stops: a net is so
/// much less of its strips.
///
/// Samples the rows of view factors: n rays leave points spread over a facet, spread themselves
/// over its hemisphere by the cosine (hemisphere_rays.hpp), and each counts 1/n towards the facet
/// it meets first, the sky, or what lies below the scene's edge. Rows are independent estimates of
/// F_ij; that A_i F_ij = A_j F_ji is left to reciprocity.hpp.
///
/// Rays of a facet whose middle lies below the ground (a box's floor that lies on it, a corner sunk
/// in a slope) would find nothing, which is no open plain: it is `buried`, and its row left empty.
///
/// Standard error of a facet's sky about 0.65/rays^0.75 (0.03 at 64 rays, 0.011 at 256, measured in
/// bowls), of means over n facets √n less; the same numbers for any number of threads. Rays above
/// everything near (sky_bound.hpp) are not traced, the others asked whether anything blocks them,
/// and those that are blocked, what (block_rays.hpp).
FacetViews facet_views(const FacetSet& facets, const RayScene& scene,
                       const FacetViewOptions& options = {});

/// The same of patches that lie on facets and that no ray knows or meets: `object_rays` of each;
/// none is buried.
///
/// - facets: those of the scene, of which `first_object` is one
FacetViews patch_views(const FacetSet& patches, const FacetSet& facets, const RayScene& scene,
                       const FacetViewOptions& options = {});

}  // namespace diurna
