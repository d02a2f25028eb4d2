#include "scenes/job/world/measured_albedo.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace diurna {

namespace {

bool reflected_light(const Weather& weather) {
    return std::any_of(weather.sample.begin(), weather.sample.end(), [](const Forcing& f) {
        return !std::isnan(f.shortwave_up) && !std::isnan(f.shortwave_down);
    });
}

}  // namespace

MeasuredAlbedo measured_albedo(const Scene& scene, const World& world, const Weather& weather) {
    const MaterialLibrary& materials = scene.materials;
    std::string over = scene.weather.measured_over;
    if (!reflected_light(weather)) {
        if (over.empty()) return {};
        return {.note = "weather.measured_over: the file has no shortwave_up and shortwave_down"};
    }
    std::set<MaterialId> used(world.surfaces().material.begin(), world.surfaces().material.end());
    std::set<std::string> kinds;
    for (const MaterialId id : used) kinds.insert(materials[id].kind());
    if (over.empty() && kinds.size() > 1) {
        return {.note = fmt::format("shortwave_up is not used: set weather.measured_over to the "
                                    "one of the {} materials below the sensor",
                                    kinds.size())};
    }
    if (over.empty()) over = *kinds.begin();
    if (kinds.count(over) == 0) {
        return {.note = fmt::format("shortwave_up is not used: no surface is of \"{}\", the "
                                    "material of weather.measured_over",
                                    over)};
    }
    const double own = materials[materials.find(over)].thermal.albedo;
    MeasuredAlbedo measured{.share = std::vector<double>(materials.size(), 0.0)};
    for (const MaterialId id : used) {
        if (materials[id].kind() != over) continue;
        measured.share[index(id)] = own > 0.0 ? materials[id].thermal.albedo / own : 1.0;
    }
    return measured;
}

}  // namespace diurna
