#pragma once

#include <array>
#include <vector>

#include "render/light/origin.hpp"
#include "render/light/radiance_terms.hpp"
#include "render/light/scene_light.hpp"
#include "render/rays/channel_lanes.hpp"

namespace diurna {

/// The terms of a surface's own radiance, all except the path's, each separately for every possible
/// origin of its light.
struct SentRow {
    Term term;
    Origin origin;
};
inline constexpr std::array<SentRow, 8> sent_rows = {{
    {Term::emitted, Origin::surface},
    {Term::behind, Origin::surface},
    {Term::sun, Origin::sunlight},
    {Term::sky, Origin::sunlight},
    {Term::sky, Origin::sky_heat},
    {Term::surroundings, Origin::surface},
    {Term::surroundings, Origin::sunlight},
    {Term::surroundings, Origin::sky_heat},
}};

/// Incident light and radiosity of the facets that rays meet, in the channels of all bands side by
/// side: rows of lanes.
class FacetLanes {
 public:
    /// For this number of the facets given to lit_facets(), from `first` on.
    ///
    /// - by_term: sent() will be used
    FacetLanes(const SceneLight& light, std::size_t first, std::size_t targets,
               const ChannelLanes& lanes, bool by_term);

    /// Black body at a facet's temperature.
    ///
    /// - target: index among these
    const float* black(std::uint32_t target) const { return row(target, 0); }
    /// Incident light from the surrounding facets, by its origin.
    const float* from_surroundings(std::uint32_t target, Origin origin) const {
        return row(target, 1 + static_cast<std::size_t>(origin));
    }
    /// Incident light of the sky: thermal or scattered sunlight.
    const float* from_sky(std::uint32_t target, Origin origin) const {
        return row(target, origin_count + static_cast<std::size_t>(origin));
    }
    /// Radiosity as a Lambertian surface.
    const float* radiosity(std::uint32_t target, Origin origin) const {
        return row(target, 2 * origin_count + static_cast<std::size_t>(origin));
    }
    /// The same by term.
    const float* sent(std::uint32_t target, std::size_t sent_row) const {
        return row(target, 3 * origin_count + sent_row);
    }

 private:
    const float* row(std::uint32_t target, std::size_t k) const {
        return &rows_[(target * rows_of_facet_ + k) * lanes_];
    }

    std::size_t lanes_, rows_of_facet_;
    std::vector<float> rows_;  // (target, row, lane)
};

}  // namespace diurna
