#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scenes/world/world.hpp"

namespace diurna {

/// The ground as which a raster goes on beyond its outline.
struct BorderGround {
    MaterialId material{};             // that most of the outline has
    double height = 0.0;               // [m] above the sea: a twentieth of the outline lies lower
    std::vector<BorderFacet> facet{};  // of that material
};

/// None of a scene without ground at the raster's outline (holes alone).
///
/// - facets: the world's surfaces, or the same with other materials
std::optional<BorderGround> border_ground(const World& world, const FacetSet& facets);

/// Of an eye's rays, those that meet nothing and point below the horizon of that ground.
///
/// - eye_height, border_height: [m] above the sea
/// - zenith_deg: of the ray
bool looks_below_horizon(double eye_height, double border_height, double zenith_deg);

}  // namespace diurna
