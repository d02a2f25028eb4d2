#pragma once

#include "materials/matter/material.hpp"
#include "thermal/surface/standing_water.hpp"

namespace diurna {

/// Optical effect of water and snow on a surface: the wet share, the share hidden by snow, and that
/// snow's broadband albedo.
struct SurfaceCover {
    float wet = 0.0f, snow = 0.0f, snow_albedo = 0.0f;

    bool any() const { return wet > 0.0f || snow > 0.0f; }
    bool operator==(const SurfaceCover&) const = default;
};

/// For a surface in its present state, by the same laws as its heat balance: wet is content over
/// capacity, at most one; snow hides depth / (depth + 5 z0) (snow_cover()), except on leaves and on
/// a material that is ageing snow, which only covers itself.
///
/// snow_albedo  of the snow on it, or of the ageing material
SurfaceCover surface_cover(const ThermalSurface& surface, const StoreCapacity& capacity,
                           const Standing& lying, double snow_albedo);

/// Whether it can have a cover.
inline bool holds_water(const ThermalSurface& surface) {
    return surface.store.capacity_mm > 0.0 || surface.snow_albedo.has_value();
}

/// The albedo of the heat balance under a cover: (1 − snow) [dry or, by share, wet] + snow ×
/// snow_albedo.
double covered_albedo(const ThermalSurface& surface, const SurfaceCover& cover);

}  // namespace diurna
