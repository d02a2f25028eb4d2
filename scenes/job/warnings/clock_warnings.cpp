#include <fmt/format.h>

#include <vector>

#include "scenes/job/warnings/scene_warnings.hpp"
#include "thermal/point/schedule_clock.hpp"

namespace diurna {

std::vector<Mistake> clock_warnings(const Prepared& prepared) {
    const Scene& scene = prepared.scene;
    const std::string change = schedule_clock_note(prepared.world.site, scene.time.utc_offset);
    std::vector<Mistake> warnings;
    if (change.empty()) return warnings;
    std::vector<bool> used(scene.materials.size());
    for (const MaterialId id : prepared.world.surfaces().material) used[index(id)] = true;
    for (std::size_t m = 0; m < used.size(); ++m) {
        const Material& material = scene.materials[MaterialId(m)];
        const std::string key = schedule_key(material.thermal);
        if (!used[m] || key.empty()) continue;
        warnings.push_back(
            {fmt::format("{}: material.{}.{}", scene.file.string(), material.kind(), key), change,
             "shift the hours if the schedule was written in solar time"});
    }
    return warnings;
}

}  // namespace diurna
