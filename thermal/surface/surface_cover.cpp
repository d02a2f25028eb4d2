#include "thermal/surface/surface_cover.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace diurna {

SurfaceCover surface_cover(const ThermalSurface& surface, const StoreCapacity& capacity,
                           const Standing& lying, double snow_albedo) {
    if (surface.snow_albedo) return {0.0f, 1.0f, float(snow_albedo)};
    if (!capacity.any()) return {};
    SurfaceCover cover;
    cover.wet = float(std::clamp(lying.water / capacity.water_mm, 0.0, 1.0));
    if (!std::holds_alternative<std::monostate>(surface.canopy)) return cover;
    cover.snow = float(snow_cover(lying.frost, surface.roughness_length).share);
    if (cover.snow > 0.0f) cover.snow_albedo = float(snow_albedo);
    return cover;
}

double covered_albedo(const ThermalSurface& surface, const SurfaceCover& cover) {
    double albedo = surface.albedo;
    if (surface.store.wet_albedo >= 0.0) {
        albedo += double(cover.wet) * (surface.store.wet_albedo - albedo);
    }
    return std::lerp(albedo, double(cover.snow_albedo), double(cover.snow));
}

}  // namespace diurna
