#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "render/view/observer.hpp"
#include "render/view/pixel_sun.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Temperature within a facet: its mean at the centroid, and a slope in plan.
struct FacetSlope {
    Eigen::Vector2f per_metre = Eigen::Vector2f::Zero();  // east, north [K m⁻¹]
    float low = 0.0f, high = 0.0f;  // [K] relative to the mean: of it and its neighbours

    /// [K] above the mean at a place relative to the centroid (east, north [m]), within the
    /// neighbours' range.
    float at(const Eigen::Vector2f& off) const {
        return std::min(std::max(per_metre.dot(off), low), high);
    }
};

/// The ground whose temperatures are given, and the sun over it.
struct GroundHeat {
    const SunOverFacets& sun;            // its facets may include the levels of textures
    std::size_t ground_facets;           // the first ones of the scene
    const TextureLevels* levels;         // of textures; null: none
    std::span<const float> temperature;  // (facet) [K]
    /// Facets whose share of the sun is known; the others count as in the same light as their
    /// neighbours. Empty: all.
    std::span<const FacetId> lit{};
};

/// Slopes of chosen facets of the ground: least squares through the means of the facet and of its
/// neighbours with a common corner, weighted by 1/distance², limited so that no corner is colder or
/// warmer than all of these (Barth & Jespersen 1989). The facet's mean is unchanged, and a
/// temperature that is linear in place is reproduced, except at borders.
///
/// Neighbours are facets of the same material and object, in planes within 60°, and not across the
/// edge of a shadow: shares of the sun's disc, times the smaller cosine of incidence, differ by
/// less than 0.02. A facet with neighbours on one line only has no slope.
///
/// - chosen: steeper than 70° they have no slope
/// - returns: (chosen)
std::vector<FacetSlope> facet_slopes(std::span<const FacetId> chosen, const GroundHeat& heat);

/// Temperature of the ground where pixels see it, relative to the means of its facets.
struct LinearGround {
    std::vector<float> warmer;         // (sighting) [K]; 0 for all else
    std::vector<float> warmer_centre;  // (pixel) [K] of the facet at its centre
    bool empty() const { return warmer.empty(); }
};

/// Slopes of all facets of the ground in a view, where its pixels' middles see them; copies and
/// moving objects have none. The same bytes for any number of threads.
LinearGround linear_ground(const View& view, const Observer& observer, const GroundHeat& heat);

}  // namespace diurna
