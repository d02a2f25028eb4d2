#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "terrain/facets.hpp"
#include "terrain/visibility/object_boxes.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

struct FacetViewOptions {
    int rays = 64;  // stratified, cosine-weighted directions per facet, 1 to 65535
    /// Facets before this one are ground, a height field; the facets from it on use this many rays
    /// instead. The view of a wall varies more from place to place than that of open ground, and
    /// thin metal reacts to every error.
    std::size_t first_object = std::numeric_limits<std::size_t>::max();
    int object_rays = 256;
    /// (ground facet) 1 if objects may be visible: `rays` estimate their share, and the smaller it
    /// is, the more further rays are traced, 2 to 64 times as many: a vehicle ten metres away
    /// hides 1 % of the sky, and 64 rays meet it once or not at all, which causes differences of
    /// 0.1 K between neighbours at night (0.007 K with 4096). Empty: nowhere.
    std::span<const std::uint8_t> near_objects{};
    /// Above which a facet sees open sky, so that rays there need not be traced; false: not known.
    /// Called from many threads. Empty: nowhere.
    std::function<bool(std::size_t facet, OpenAbove&)> open_above{};
    std::uint64_t seed = 1;
    bool others = true;     // or leave their rows empty
    bool sunlight = false;  // transmittance of facets for the sun's spectrum; else thermal
};

/// Rays continue through transparent facets (RayScene), which count by the share they stop: a net
/// counts as that share of its strips.
///
/// Samples the rows of view factors: n rays leave points spread over a facet, cosine-distributed
/// over its hemisphere (hemisphere_rays.hpp), and each counts 1/n for the first facet it meets, the
/// sky, or the space below the scene's edge. Rows are independent estimates of F_ij;
/// reciprocity.hpp makes A_i F_ij = A_j F_ji.
///
/// A facet whose centroid is below the ground (a box's floor on the ground, a corner sunk in a
/// slope) is marked `buried` and its row left empty: its rays would find no surroundings.
///
/// Standard error of a facet's sky about 0.65/rays^0.75 (0.03 at 64 rays, 0.011 at 256, measured in
/// bowls), of means over n facets √n less; the same numbers for any number of threads. Rays above
/// everything near (sky_bound.hpp) are not traced; the others are tested for occlusion, and only
/// for occluded ones is the nearest facet searched (block_rays.hpp).
FacetViews facet_views(const FacetSet& facets, const RayScene& scene,
                       const FacetViewOptions& options = {});

/// The same for patches on facets that rays do not meet: `object_rays` for each; none is
/// buried.
///
/// - facets: those of the scene, of which `first_object` is one
FacetViews patch_views(const FacetSet& patches, const FacetSet& facets, const RayScene& scene,
                       const FacetViewOptions& options = {});

}  // namespace diurna
