#include "scenes/doubts/doubts.hpp"

#include <algorithm>

#include "thermal/weather/weather_doubts.hpp"

namespace diurna {

std::vector<Mistake> doubts(const Prepared& prepared) {
    const Scene& scene = prepared.scene;
    std::vector<Mistake> all = weather_doubts(
        prepared.weather, prepared.world.site, scene.time.start,
        later(scene.time.start, scene.time.duration), scene.file.string() + ": weather.file");
    all.insert(all.begin(), prepared.warnings.begin(), prepared.warnings.end());
    for (auto of :
         {place_doubts, shape_doubts, object_doubts, stand_doubts, view_doubts, clock_doubts}) {
        for (Mistake& doubt : of(prepared)) all.push_back(std::move(doubt));
    }
    return all;
}

std::vector<std::string> as_lines(const std::vector<Mistake>& doubts) {
    std::vector<std::string> lines;
    for (const Mistake& doubt : doubts) {
        const std::string line = doubt.line();
        if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    }
    return lines;
}

}  // namespace diurna
