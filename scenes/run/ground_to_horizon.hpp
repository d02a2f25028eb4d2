#pragma once

#include <optional>
#include <span>

#include "render/light/radiance_input.hpp"
#include "render/view/view.hpp"
#include "scenes/world/border_ground.hpp"

namespace diurna {

/// The ground beyond the raster at an instant: as warm as the level, open ground of its material at
/// the raster's outline, whose heat balance it shares; none of a scene without an outline.
///
/// - facets: World::surfaces(), as they are at that instant (wet, under snow)
/// - temperature, sky_view: (facet)
std::optional<FarGround> far_ground(const World& world, const FacetSet& facets,
                                    std::span<const float> temperature,
                                    std::span<const float> sky_view);

/// That, if a view looks below its horizon where the scene ends; else none, so that pictures that
/// see nothing of it do not depend on it.
std::optional<FarGround> seen_beyond(const View& view, const std::optional<FarGround>& ground,
                                     double ground_height_km);

}  // namespace diurna
