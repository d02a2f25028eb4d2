#include "scenes/job/input/read_plumes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

PlumeInput read_plume(const Section& section, const ScenePlaces& places) {
    PlumeInput plume;
    plume.name = section.text("name", "name of the plume");
    plume.stands = read_height(section, "height of its base", 0.0, {0.0, 1e4});
    plume.place =
        places.one(section, {"place_m", "place"}, "place of the centre of its base", plume.stands);
    plume.height = section.number("height_m", "height from its base to its top", {0.1, 1e4});
    plume.radius = section.number("radius_m", "radius of its base", {0.01, 1e3});
    plume.top_radius = section.number_or("top_radius_m", "radius of its top",
                                         {plume.radius, "radius_m"}, {0.01, 1e3});
    const std::vector<double> lean = section.numbers_or(
        "lean_m", "[east, north] of its top from its base", std::vector{0.0, 0.0}, 2);
    constexpr double furthest = 1e4;  // [m] as a plume is high
    if (!(std::hypot(lean[0], lean[1]) <= furthest)) {
        section.mistake(
            "lean_m", fmt::format("found a top {:g} m from above its base, expected at most {:g} m",
                                  std::hypot(lean[0], lean[1]), furthest));
    }
    plume.lean = {lean[0], lean[1]};
    plume.temperature = section.number(
        "temperature_K", "temperature of the gas or smoke, at which it emits", {150.0, 3000.0});
    plume.absorption = flat_spectrum(0.0);
    if (!section.has("absorption")) {
        plume.absorption = flat_spectrum(section.number(
            "absorption_per_m",
            "Beer's absorption coefficient at all wavelengths, unless `absorption` is given",
            {0.0, 1e4}));
        return plume;
    }
    plume.file = section.file(
        "absorption", "CSV file of Beer's absorption coefficient over wavelength_um, per m");
    try {
        if (!plume.file.empty()) plume.absorption = read_spectrum(plume.file, 0.0, 1e4);
    } catch (const InputError& error) {
        section.mistake("absorption", error.what());
    }
    return plume;
}

}  // namespace

std::vector<PlumeInput> read_plumes(const Section& root, const ScenePlaces& places) {
    std::vector<PlumeInput> plumes;
    for (const Section& section : root.sections(
             "plume", "gas or smoke: an inclined frustum that absorbs by Beer's law and emits")) {
        plumes.push_back(read_plume(section, places));
    }
    return plumes;
}

}  // namespace diurna
