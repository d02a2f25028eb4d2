#pragma once

#include <optional>
#include <span>

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

/// The same if a view looks below its horizon beyond the scene; else none, so that pictures that do
/// not see it do not depend on it.
std::optional<FarGround> seen_beyond(const View& view, const std::optional<FarGround>& ground,
                                     double ground_height_km);

}  // namespace diurna
