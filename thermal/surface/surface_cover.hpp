#pragma once

#include "materials/matter/material.hpp"
#include "thermal/surface/standing_water.hpp"

namespace diurna {

/// What water makes of a surface to light: the share that is wet, the share of all that snow hides,
/// and that snow's broadband albedo.
struct SurfaceCover {
    float wet = 0.0f, snow = 0.0f, snow_albedo = 0.0f;

    bool any() const { return wet > 0.0f || snow > 0.0f; }
    bool operator==(const SurfaceCover&) const = default;
};

/// Of a surface as it is, by the same laws as its heat balance: wet is content over capacity, one
/// at the most; snow hides depth / (depth + 5 z0) (snow_cover()), but lies neither on leaves nor on
/// a material that itself is ageing snow, which is covered by itself.
///
/// snow_albedo  of the snow that lies there, or of the material that ages
SurfaceCover surface_cover(const ThermalSurface& surface, const StoreCapacity& capacity,
                           const Standing& lying, double snow_albedo);

/// Whether it may ever be covered.
inline bool holds_water(const ThermalSurface& surface) {
    return surface.store.capacity_mm > 0.0 || surface.snow_albedo.has_value();
}

/// The albedo of the heat balance under a cover: (1 − snow) [dry or, by share, wet] + snow ×
/// snow_albedo.
double covered_albedo(const ThermalSurface& surface, const SurfaceCover& cover);

}  // namespace diurna
