#include "scenes/input/read_plumes.hpp"

#include "materials/base/error.hpp"

namespace diurna {

std::vector<PlumeInput> read_plumes(const Section& root, const Reading& reading) {
    std::vector<PlumeInput> plumes;
    for (const Section& section : root.sections("plume")) {
        PlumeInput plume;
        plume.name = section.text("name");
        plume.place = place(section, "place_m");
        plume.height_above_ground = section.number_or("height_above_ground_m", 0.0, 0.0, 1e4);
        plume.height = section.number("height_m", 0.1, 1e4);
        plume.radius = section.number("radius_m", 0.01, 1e3);
        plume.top_radius = section.number_or("top_radius_m", plume.radius, 0.01, 1e3);
        const std::vector<double> lean = section.numbers_or("lean_m", {0.0, 0.0}, 2);
        plume.lean = {lean[0], lean[1]};
        plume.temperature = section.number("temperature_K", 150.0, 3000.0);
        plume.absorption = flat_spectrum(0.0);
        if (section.has("absorption")) {
            plume.file = reading.folder / section.text("absorption");
            try {
                plume.absorption = read_spectrum(plume.file, 0.0, 1e4);
            } catch (const InputError& error) {
                section.mistake("absorption", error.what());
            }
        } else {
            plume.absorption = flat_spectrum(section.number("absorption_per_m", 0.0, 1e4));
        }
        plumes.push_back(std::move(plume));
    }
    return plumes;
}

}  // namespace diurna
