#include "render/light/node_optics.hpp"

#include <variant>

#include "materials/radiation/planck.hpp"
#include "render/light/radiance.hpp"

namespace diurna {

std::vector<NodeOptics> node_optics(const Band& band, const MaterialLibrary& materials,
                                    const std::vector<bool>& used) {
    const std::size_t nodes = band.node_um.size();
    std::vector<NodeOptics> all(materials.size());
    for (std::size_t m = 0; m < all.size(); ++m) {
        if (!used[m]) continue;
        const Material& material = materials[MaterialId{static_cast<std::uint16_t>(m)}];
        NodeOptics& optics = all[m];
        optics.transparent = !material.transmittance.empty();
        optics.transmittance.assign(nodes, 0.0);
        for (std::size_t n = 0; n < nodes; ++n) {
            const double reflectance = material.reflectance.at(band.node_um[n]);
            if (optics.transparent) {
                optics.transmittance[n] = material.transmittance.at(band.node_um[n]);
            }
            optics.reflectance.push_back(reflectance);
            optics.emissivity.push_back(1.0 - reflectance - optics.transmittance[n]);
        }
        if (optics.transparent && std::holds_alternative<Interior>(material.thermal.bottom)) {
            const double behind = temperature_behind(material, 0.0);
            for (std::size_t n = 0; n < nodes; ++n) {
                optics.room.push_back(optics.transmittance[n] * planck(band.node_um[n], behind));
            }
        }
    }
    return all;
}

}  // namespace diurna
