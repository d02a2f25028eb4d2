#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/job/warnings/scene_warnings.hpp"

namespace diurna {

namespace {

/// Light that was measured under a sky, which pictures of a vacuum do not have.
void warn_of_light_in_vacuum(const Prepared& prepared, std::vector<Mistake>& warnings) {
    double sun = 0.0, diffuse = 0.0, longwave = 0.0;
    for (const Forcing& f : prepared.weather.sample) {
        sun = std::fmax(sun, std::fmax(f.shortwave_down, f.direct_normal));
        diffuse = std::fmax(diffuse, f.diffuse);
        longwave = std::fmax(longwave, f.longwave_down);
    }
    constexpr double little = 5.0;  // [W m⁻²]
    if (sun <= little && diffuse <= little && longwave <= little) return;
    warnings.push_back(
        {fmt::format("{}: atmosphere.profile", prepared.scene.file.string()),
         fmt::format(
             "pictures of a vacuum have the sun in space and a black sky, but the weather "
             "has up to {:.0f} W/m2 of sun, {:.0f} W/m2 of diffuse light and {:.0f} W/m2 of "
             "longwave, which the heat balance uses",
             sun, diffuse, longwave),
         "remove these columns, or name a profile"});
}

}  // namespace

std::vector<Mistake> light_warnings(const Prepared& prepared) {
    const Scene& scene = prepared.scene;
    std::vector<Mistake> warnings;
    for (const std::string& key : scene.idle_sky_keys) {
        warnings.push_back({fmt::format("{}: sky.{}", scene.file.string(), key),
                            scene.air.vacuum ? "has no effect in a vacuum"
                                             : "does not set the light of clear skies, which "
                                               "comes from [atmosphere]; it changes only the clear "
                                               "sky that measured sunlight is compared with",
                            scene.air.vacuum ? "remove the key"
                                             : "set atmosphere.visibility_km and its other keys, "
                                               "or atmosphere.drives_heat = false for the formulas "
                                               "of [sky]"});
    }
    const auto& samples = prepared.weather.sample;
    if (std::any_of(samples.begin(), samples.end(),
                    [](const Forcing& f) { return !std::isnan(f.plane_of_array); })) {
        warnings.push_back({fmt::format("{}: weather.file", scene.file.string()),
                            "plane_of_array_W_m2 is not used by a scene, whose facets lean "
                            "different ways",
                            "measure global or direct and diffuse light; `diurna column` uses it"});
    }
    if (scene.air.vacuum) warn_of_light_in_vacuum(prepared, warnings);
    return warnings;
}

}  // namespace diurna
