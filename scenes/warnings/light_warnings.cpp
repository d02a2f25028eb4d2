#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/warnings/scene_warnings.hpp"

namespace diurna {

std::vector<Mistake> light_warnings(const Prepared& prepared) {
    const Scene& scene = prepared.scene;
    std::vector<Mistake> warnings;
    for (const std::string& key : scene.idle_sky_keys) {
        warnings.push_back({fmt::format("{}: sky.{}", scene.file.string(), key),
                            "has no effect on clear skies: their light comes from [atmosphere]",
                            "set atmosphere.visibility_km and its other keys, or "
                            "atmosphere.drives_heat = false for the formulas of [sky]"});
    }
    const auto& samples = prepared.weather.sample;
    if (std::any_of(samples.begin(), samples.end(),
                    [](const Forcing& f) { return !std::isnan(f.plane_of_array); })) {
        warnings.push_back({fmt::format("{}: weather.file", scene.file.string()),
                            "plane_of_array_W_m2 is not used by a scene, whose facets lean "
                            "different ways",
                            "measure global or direct and diffuse light; `diurna column` uses it"});
    }
    return warnings;
}

}  // namespace diurna
