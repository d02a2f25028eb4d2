#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "scenes/job/world/world.hpp"

namespace diurna {

/// The ground that continues a raster beyond its outline.
struct BorderGround {
    MaterialId material{};             // most frequent on the outline
    double height = 0.0;               // [m] above the sea: 5 % of the outline is lower
    std::vector<BorderFacet> facet{};  // of that material
};

/// None for a scene without ground at the raster's outline (only holes).
///
/// - facets: the world's surfaces, or the same with other materials
std::optional<BorderGround> border_ground(const World& world, const FacetSet& facets);

/// Whether a ray that meets nothing points below the horizon of that ground.
///
/// - eye_height, border_height: [m] above the sea
/// - zenith_deg: of the ray
bool looks_below_horizon(double eye_height, double border_height, double zenith_deg);

}  // namespace diurna
