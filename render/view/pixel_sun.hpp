#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "render/view/observer.hpp"
#include "render/view/view.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// The sun over a scene at an instant.
struct SunOverFacets {
    const RayScene& rays;
    const FacetSet& facets;           // copies of textured ones included
    std::span<const float> fraction;  // (facet) share that the sun reaches; empty: no sun
    Eigen::Vector3d to_sun;           // unit
    /// (facet) Where things go: the same while they are where they are at the times 0 and 1 of
    /// rays, for where their shadows' edges may be; empty: nothing goes.
    std::span<const float> before{}, after{};
};

/// The share of the sun's disc that reaches what single pixels see of facets that shadows' edges
/// cross. The mean of a facet alone would draw a shadow in pieces as large as facets.
struct PixelSun {
    std::vector<std::uint32_t> pixel;     // ascending
    std::vector<std::uint32_t> row;       // (pixel + 1) entries of pixel k: [row[k], row[k + 1])
    std::vector<std::uint32_t> sighting;  // (entry) index into View::sighting
    std::vector<float> share;             // (entry) 0 to 1
    std::vector<std::uint8_t> crossed{};  // facets_with_edges()
    std::vector<float> warmer{};          // (entry) [K] than its facet (pixel_heat.hpp); empty: not
    std::uint64_t rays = 0;               // cast to the sun
};

/// (facet that rays know) 1 where an edge of a shadow may cross: turned to the sun, and the shares
/// of it and of those it has a corner in common with are not all nought or all one. A shadow that
/// lies in the midst of facets whose samples all miss it is not found.
std::vector<std::uint8_t> facets_with_edges(const SunOverFacets& sun, const TextureLevels* levels);

/// Casts the samples of those pixels again that see such facets, and a ray from each place on them
/// to a place of the sun's disc; panes and nets on its way dim it. The share of a sighting is the
/// mean over its samples: of a row of them first (4 of 16), and of the others where these differ or
/// are few. Levels of a textured facet in a pixel have the same. The same bytes for
/// any number of threads.
///
/// - options: as the view was cast; of an adaptive one `samples` are taken in every pixel
PixelSun cast_pixel_sun(const View& view, const SunOverFacets& sun, const Observer& observer,
                        const ViewOptions& options);

}  // namespace diurna
