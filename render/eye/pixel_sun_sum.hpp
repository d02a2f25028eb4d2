#pragma once

#include <span>
#include <vector>

#include "render/eye/eye_tables.hpp"
#include "render/view/pixel_sun.hpp"

namespace diurna {

/// Puts the sun that reaches single pixels in the place of their facets' mean: radiance is linear
/// in the sunlit share, so weight × (share − mean) × what the whole sun adds is added.
///
/// - planes: (column)(pixel), columns as of the tables
void add_pixel_sun(const View& view, const PixelSun& sun, const SceneLight& light,
                   const EyeTables& tables, std::span<std::vector<float>> planes);

/// Adds what pixels that are warmer than their facets' mean send more (pixel_heat.hpp).
void add_pixel_heat(const View& view, const PixelSun& sun, const SceneLight& light,
                    const EyeTables& tables, std::span<std::vector<float>> planes);

}  // namespace diurna
