#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "render/view/corner_fits.hpp"
#include "render/view/observer.hpp"
#include "render/view/pixel_sun.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Temperature within a facet, linear in plan on ground and in its plane on objects, relative to
/// the facet's own.
struct FacetSlope {
    Eigen::Vector3f per_metre = Eigen::Vector3f::Zero();  // east, north, up [K m⁻¹]
    float offset = 0.0f;                                  // [K] at the centroid
    float low = 0.0f, high = 0.0f;                        // [K] of it and its neighbours

    /// [K] at a place relative to the centroid (east, north, up [m]), within the neighbours' range.
    float at(const Eigen::Vector3f& off) const {
        return std::min(std::max(offset + per_metre.dot(off), low), high);
    }
    bool flat() const { return per_metre.isZero() && offset == 0.0f; }
};

/// [K] largest difference between a facet's temperature and the mean of its linear one that counts
/// as chance (rays to sky and sun) and is levelled; beyond three times of it the mean is kept.
inline constexpr float chance_difference = 0.15f;

/// Surfaces whose temperatures are given, and the sun over them.
struct FacetHeat {
    const SunOverFacets& sun;            // its facets may include the levels of textures
    std::span<const float> temperature;  // (facet) [K]
    /// Facets whose share of the sun is known; the others count as in the same light as their
    /// neighbours. Empty: all.
    std::span<const SurfaceId> lit{};
};

/// Slopes of chosen facets: through the temperatures of their corners, each the value
/// there of the plane that fits the facets around it best (least squares, weighted by 1/distance²),
/// within their range. So the temperature has no step from facet to facet where it is smooth, what
/// chance adds to single facets is averaged over those around a corner, and a temperature that is
/// linear in place is reproduced, except at borders. A facet that differs from its corners by more
/// than chance keeps its mean; its slope is then limited so that no corner is colder or warmer than
/// all neighbours (Barth & Jespersen 1989).
///
/// Neighbours are facets of the same material and object, in planes within 60° on the ground and
/// 20° on objects, and not across the edge of a shadow: shares of the sun's disc, times the smaller
/// cosine of incidence, differ by less than 0.02.
///
/// returns  (chosen)
///
/// - fits: of the chosen facets
std::vector<FacetSlope> facet_slopes(const CornerFits& fits, const FacetHeat& heat);

/// Temperature of surfaces where pixels see them, relative to their facets' own.
struct LinearFacets {
    std::vector<float> warmer;         // (sighting) [K]; 0 for all else
    std::vector<float> warmer_centre;  // (pixel) [K] of the facet at its centre
    bool empty() const { return warmer.empty(); }
};

/// Slopes of all facets in a view, where its pixels' middles see them; copies have none. The same
/// bytes for any number of threads.
///
/// - fits: of facets_with_slopes()
LinearFacets linear_facets(const View& view, const Observer& observer, const CornerFits& fits,
                           const FacetHeat& heat);

/// Facets that a view sees, those of copies excepted; ascending, each once.
std::vector<SurfaceId> facets_with_slopes(const View& view);

}  // namespace diurna
