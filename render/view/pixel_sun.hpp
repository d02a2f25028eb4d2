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
    const FacetSet& facets;           // copies for textures included
    std::span<const float> fraction;  // (facet) sunlit share; empty: no sun
    Eigen::Vector3d to_sun;           // unit
    /// (facet) For moving objects: the same at the positions of ray times 0 and 1, to find where
    /// their shadows' edges may be; empty: no motion.
    std::span<const float> before{}, after{};
};

/// The share of the sun's disc visible from the part of a facet seen by a pixel, for facets that
/// shadows' edges cross. With the mean of a facet alone a shadow's edge would follow the facets.
struct PixelSun {
    std::vector<std::uint32_t> pixel;     // ascending
    std::vector<std::uint32_t> row;       // (pixel + 1) entries of pixel k: [row[k], row[k + 1])
    std::vector<std::uint32_t> sighting;  // (entry) index into View::sighting
    std::vector<float> share;             // (entry) 0 to 1
    std::vector<std::uint8_t> crossed{};  // facets_with_edges()
    std::vector<float> warmer{};          // (entry) [K] than its facet (pixel_heat.hpp); or empty
    std::uint64_t rays = 0;               // cast to the sun
};

/// (facet known to rays) 1 if a shadow's edge may cross it: it faces the sun, and the shares of it
/// and of those with a common corner are neither all zero nor all one. A shadow inside facets whose
/// samples all miss it is not detected.
std::vector<std::uint8_t> facets_with_edges(const SunOverFacets& sun, const TextureLevels* levels);

/// Casts the samples again of pixels that see such facets, and from each hit on them a ray to a
/// point of the sun's disc; panes and nets in between attenuate it. The share of a sighting is the
/// mean over its samples: of a row of them first (4 of 16), and of the others if these differ or
/// are few. All levels of a textured facet in a pixel have the same. The same bytes for any number
/// of threads.
///
/// - options: those of the view; for an adaptive one `samples` are taken in every pixel
PixelSun cast_pixel_sun(const View& view, const SunOverFacets& sun, const Observer& observer,
                        const ViewOptions& options);

}  // namespace diurna
