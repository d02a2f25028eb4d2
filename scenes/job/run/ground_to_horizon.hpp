#pragma once

#include <optional>
#include <span>
#include <vector>

#include "render/light/radiance_input.hpp"
#include "render/view/view.hpp"
#include "scenes/job/world/border_ground.hpp"

namespace diurna {

/// The ground beyond the raster at an instant: at the temperature of level, open ground of its
/// material at the raster's outline, with its heat balance; none for a scene without an
/// outline.
///
/// - facets: World::surfaces(), in their state at that instant (wet, under snow)
/// - temperature, sky_view: (facet)
std::optional<FarGround> far_ground(const World& world, const FacetSet& facets,
                                    std::span<const float> temperature,
                                    std::span<const float> sky_view);

/// The facets whose mean temperature, by length, that is.
///
/// - border: border_ground() of those facets
std::vector<BorderFacet> far_ground_facets(const BorderGround& border, const FacetSet& facets,
                                           std::span<const float> sky_view);

/// Whether a view looks below its horizon beyond the scene.
///
/// - border_height, ground_height: [m] of BorderGround, and of World::sea_level_height, above the
///   sea
bool sees_beyond(const View& view, double border_height, double ground_height);

/// The same ground if a view looks below its horizon beyond the scene; else none, so that pictures
/// that do not see it do not depend on it.
std::optional<FarGround> seen_beyond(const View& view, const std::optional<FarGround>& ground,
                                     double ground_height_km);

}  // namespace diurna
