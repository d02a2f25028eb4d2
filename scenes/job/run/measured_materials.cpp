#include "scenes/job/run/measured_materials.hpp"

#include <algorithm>
#include <cmath>

#include "materials/matter/varied.hpp"
#include "scenes/job/world/instant_lights.hpp"
#include "scenes/job/world/measured_albedo.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/solve/solve_input.hpp"

namespace diurna {

std::optional<MaterialLibrary> measured_materials(const Prepared& prepared, Instant instant) {
    const Scene& scene = prepared.scene;
    const auto measured = measured_albedo(scene, prepared.world, prepared.weather);
    if (measured.share.empty()) return std::nullopt;
    const SkyState sky =
        prepared.light->sky().at(instant, sun_position(prepared.world.site, instant));
    if (std::isnan(sky.albedo)) return std::nullopt;
    std::vector<Material> all;
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
        Material material = scene.materials[MaterialId(m)];
        const double albedo = measured_albedo(sky, measured.share[m]);
        if (!std::isnan(albedo)) {
            const double most = 1.0 - material.thermal.solar_transmittance;
            material = with_albedo(std::move(material), std::min(albedo, most));
        }
        all.push_back(std::move(material));
    }
    return MaterialLibrary(std::move(all));
}

}  // namespace diurna
