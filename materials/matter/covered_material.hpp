#pragma once

#include "materials/matter/material.hpp"

namespace diurna {

/// What water makes of a surface.
struct MaterialCover {
    double wet = 0.0;          // share of what snow leaves open, 0 to 1
    double snow = 0.0;         // share that snow hides, 0 to 1
    double snow_albedo = 0.0;  // broadband
};

/// A material as a picture shows it under a cover, (1 − snow) [dry or, by share, wet] + snow × the
/// spectrum of snow of that albedo (snow_reflectance.hpp); its mean under the sun at the ground
/// moves as the albedo of the heat balance does.
///
/// Wet: of a material with a wet_albedo; without one the balance knows no difference, and nor has
/// the picture. Snow is alike at every angle, opaque, and leaves the finish to what it does not
/// hide; of a measured finish the lobe is then spread evenly.
Material covered_material(Material material, const MaterialCover& cover);

/// Its spectrum where it is wet: by the law of a film of water over what is rough and absorbs
/// (wet_reflectance.hpp) where light goes alike into all directions, then moved in sunlight to the
/// material's wet_albedo; of other finishes only moved.
Spectrum wet_spectrum(const Material& material);

}  // namespace diurna
