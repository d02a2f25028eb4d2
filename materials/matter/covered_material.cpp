#include "materials/matter/covered_material.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <variant>

#include "materials/matter/snow_reflectance.hpp"
#include "materials/matter/varied.hpp"
#include "materials/matter/wet_reflectance.hpp"

namespace diurna {

Spectrum wet_spectrum(const Material& material) {
    const double albedo = material.thermal.store.wet_albedo;
    Material wet = material;
    if (albedo < 0.0) return wet.reflectance;
    if (std::holds_alternative<Lambert>(material.finish) && material.transmittance.empty()) {
        wet.reflectance = wet_reflectance(material.reflectance);
    }
    const double most = 1.0 - material.thermal.solar_transmittance;
    return with_albedo(std::move(wet), std::min(albedo, most)).reflectance;
}

Material covered_material(Material material, const MaterialCover& cover) {
    ThermalSurface& thermal = material.thermal;
    if (cover.wet > 0.0 && thermal.store.wet_albedo >= 0.0) {
        material.reflectance =
            mixed_spectrum(material.reflectance, wet_spectrum(material), cover.wet);
        thermal.albedo = std::lerp(thermal.albedo, thermal.store.wet_albedo, cover.wet);
    }
    if (cover.snow <= 0.0) return material;
    auto over = std::make_shared<SnowOver>();
    over->share = cover.snow;
    over->reflectance = snow_reflectance(cover.snow_albedo);
    over->bare_reflectance = material.reflectance;
    over->bare_transmittance = material.transmittance;
    material.reflectance = mixed_spectrum(material.reflectance, over->reflectance, cover.snow);
    for (double& value : material.transmittance.value) value *= 1.0 - cover.snow;
    thermal.solar_transmittance *= 1.0 - cover.snow;
    thermal.albedo = std::lerp(thermal.albedo, cover.snow_albedo, cover.snow);
    if (auto* table = std::get_if<ByAngle>(&material.finish)) table->measured = nullptr;
    if (!std::holds_alternative<Lambert>(material.finish)) material.snow_over = std::move(over);
    return material;
}

}  // namespace diurna
