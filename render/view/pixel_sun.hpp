#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "render/view/observer.hpp"
#include "render/view/past_sun.hpp"
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
    /// (facet) The same at other moments whose edges count as well: of moving objects at ray times
    /// 0 and 1, and in the hours before.
    std::vector<std::span<const float>> also{};
    const PastSun* past = nullptr;  // null: temperatures follow the present sun
};

/// The share of the sun's disc visible from the part of a facet seen by a pixel, for facets that
/// shadows' edges cross. With the mean of a facet alone a shadow's edge would follow the facets.
struct PixelSun {
    std::vector<std::uint32_t> pixel;     // ascending
    std::vector<std::uint32_t> row;       // (pixel + 1) entries of pixel k: [row[k], row[k + 1])
    std::vector<std::uint32_t> sighting;  // (entry) index into View::sighting
    std::vector<float> share;             // (entry) 0 to 1
    std::vector<float> past_share{};      // (entry) over SunOverFacets::past; empty: none
    std::vector<std::uint8_t> crossed{};  // facets_with_edges()
    std::vector<float> warmer{};          // (entry) [K] than its facet (pixel_heat.hpp); or empty
    std::vector<float> kelvins{};         // (entry) [K] from shade to full sun, with `warmer`
    std::uint64_t rays = 0;               // cast to the sun
};

/// (facet known to rays) 1 if a shadow's edge may cross it: it faces the sun, and the shares of it
/// and of those with a common corner are neither all zero nor all one. A shadow inside facets whose
/// samples all miss it is not detected.
std::vector<std::uint8_t> facets_with_edges(const SunOverFacets& sun, const TextureLevels* levels);

/// Casts the samples again of pixels that see such facets, and from each hit on them a ray to a
/// point of the sun's disc; panes and nets in between attenuate it. The share of a sighting is the
/// mean over its samples: of a row of them first (4 of 16), and of the others if these differ or
/// are few. All levels of a textured facet in a pixel have the same. The past share has all
/// samples, each with a past sun of its own. The same bytes for any number of threads.
///
/// - options: those of the view; for an adaptive one `samples` are taken in every pixel
PixelSun cast_pixel_sun(const View& view, const SunOverFacets& sun, const Observer& observer,
                        const ViewOptions& options);

}  // namespace diurna
