#include "render/light/far_ground.hpp"

#include <cmath>

#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/node_optics.hpp"

namespace diurna {

LightByOrigin far_ground_light(const RadianceInput& input, std::span<const double> node_um,
                               const ScatteredSun* scattered) {
    if (!input.beyond) return {};
    return far_ground_light(input, node_um,
                            incident_light(input, input.beyond->height_km, node_um, scattered));
}

LightByOrigin far_ground_light(const RadianceInput& input, std::span<const double> node_um,
                               const IncidentLight& falls) {
    LightByOrigin light;
    if (!input.beyond) return light;
    const FarGround& ground = *input.beyond;
    const double on_level = sunlight_on(1.0, std::cos(radians(input.sun_zenith_deg)));
    const bool sunny = !input.sun_fraction.empty() && on_level > 0.0;
    for (std::size_t n = 0; n < node_um.size(); ++n) {
        const double reflectance =
            optics_at(input.materials[ground.material], node_um[n]).reflectance;
        from(light, Origin::surface)
            .push_back((1.0 - reflectance) * planck(node_um[n], ground.temperature));
        from(light, Origin::sky_heat).push_back(reflectance * falls.sky_from(Origin::sky_heat, n));
        if (!sunny) continue;
        from(light, Origin::sunlight)
            .push_back(reflectance *
                       (on_level * falls.from_sun(n) + falls.sky_from(Origin::sunlight, n)));
    }
    return light;
}

OnwardLight onward_from_plain(const RadianceInput& input, std::span<const double> node_um) {
    return {input.atmosphere, input.plain_height_km(), input.sun_zenith_deg, node_um, false};
}

}  // namespace diurna
