#pragma once

#include <span>
#include <vector>

#include "render/eye/eye_tables.hpp"
#include "render/view/pixel_sun.hpp"

namespace diurna {

/// Replaces the mean sunlit share of facets by that of single pixels: radiance is linear in the
/// share, so weight × (share − mean) × contribution of the whole sun is added.
///
/// - planes: (column)(pixel), columns as of the tables
void add_pixel_sun(const View& view, const PixelSun& sun, const SceneLight& light,
                   const EyeTables& tables, std::span<std::vector<float>> planes);

/// Adds the emission of pixels that are warmer than their facets' mean (pixel_heat.hpp).
void add_pixel_heat(const View& view, const PixelSun& sun, const SceneLight& light,
                    const EyeTables& tables, std::span<std::vector<float>> planes);

}  // namespace diurna
