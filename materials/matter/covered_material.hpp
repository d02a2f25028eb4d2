#pragma once

#include "materials/matter/material.hpp"

namespace diurna {

/// Water and snow on a surface.
struct MaterialCover {
    double wet = 0.0;          // share of the snow-free surface, 0 to 1
    double snow = 0.0;         // share hidden by snow, 0 to 1
    double snow_albedo = 0.0;  // broadband
};

/// A material as shown in a picture under a cover: (1 − snow) [dry or, by share, wet] + snow × the
/// spectrum of snow of that albedo (snow_reflectance.hpp); its mean under the sun at the ground
/// changes as the albedo of the heat balance does.
///
/// Wet: only materials with a wet_albedo; without one neither the heat balance nor the picture
/// changes. Snow is opaque and the same at every angle; the finish applies to the rest; the lobe of
/// a measured finish becomes Lambertian.
Material covered_material(Material material, const MaterialCover& cover);

/// Its spectrum where it is wet: of a Lambertian finish by the law of a water film over a rough,
/// absorbing surface (wet_reflectance.hpp), then moved in sunlight to the material's wet_albedo; of
/// other finishes only moved.
Spectrum wet_spectrum(const Material& material);

}  // namespace diurna
