#include "render/light/node_optics.hpp"

#include <variant>

#include "materials/matter/passed_light.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

SurfaceOptics optics_at(const Material& material, double wavelength_um) {
    const double reflectance = material.reflectance.at(wavelength_um);
    const double transmittance =
        material.transmittance.empty() ? 0.0 : material.transmittance.at(wavelength_um);
    return {1.0 - reflectance - transmittance, reflectance, transmittance};
}

std::vector<NodeOptics> node_optics(const Band& band, const MaterialLibrary& materials,
                                    const std::vector<bool>& used) {
    std::vector<NodeOptics> all(materials.size());
    for (std::size_t m = 0; m < all.size(); ++m) {
        if (!used[m]) continue;
        const Material& material = materials[MaterialId{static_cast<std::uint16_t>(m)}];
        NodeOptics& optics = all[m];
        optics.transparent = !material.transmittance.empty();
        for (const double um : band.node_um) {
            const SurfaceOptics at = optics_at(material, um);
            optics.emissivity.push_back(at.emissivity);
            optics.reflectance.push_back(at.reflectance);
            optics.transmittance.push_back(at.transmittance);
        }
        if (optics.transparent && std::holds_alternative<Interior>(material.thermal.bottom)) {
            const double behind = temperature_behind(material, 0.0);
            for (std::size_t n = 0; n < band.node_um.size(); ++n) {
                optics.room.push_back(optics.transmittance[n] * planck(band.node_um[n], behind));
            }
        }
        if (optics.room.empty()) optics.passed = passed_heat(material);
    }
    return all;
}

double temperature_behind(const Material& material, double facet_temperature) {
    const auto* room = std::get_if<Interior>(&material.thermal.bottom);
    return room ? room->air_temperature : facet_temperature;
}

}  // namespace diurna
