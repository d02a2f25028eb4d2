#include "scenes/input/read_land.hpp"

#include <charconv>
#include <cmath>

namespace diurna {

LandCoverInput read_land_cover(const Section& section, const Reading& reading) {
    LandCoverInput input;
    input.file = reading.file(section, "file");
    const Section table = section.section("material", true);
    for (const std::string& key : table.free_keys()) {
        int value = 0;
        const auto [end, problem] = std::from_chars(key.data(), key.data() + key.size(), value);
        if (problem != std::errc() || end != key.data() + key.size()) {
            table.mistake(key, "expected a class, a whole number");
            continue;
        }
        input.material[value] = reading.material(table, key);
    }
    return input;
}

ShapesInput read_shapes_input(const Section& section, const Reading& reading) {
    ShapesInput input;
    input.file = reading.file(section, "file");
    input.name = section.text_or("name", input.file.stem().string());
    input.largest_edge = section.number_or("largest_edge_m", 30.0, 1.0, 1e4);
    input.buildings = section.has("wall") || section.has("roof");
    if (input.buildings) {
        input.wall = reading.material(section, "wall");
        input.roof = section.has("roof") ? reading.material(section, "roof") : input.wall;
        input.height_field = section.text_or("height_field", "");
        input.default_height = section.number_or("height_m", input.default_height, 0.5, 1000.0);
        if (input.height_field.empty() && std::isnan(input.default_height)) {
            section.mistake("height_m", "missing, expected it or a height_field");
        }
        return input;
    }
    input.line_width = section.number_or("line_width_m", 6.0, 0.1, 1000.0);
    if (section.has("material")) {
        input.default_material = reading.material(section, "material");
    }
    if (section.has("field")) {
        input.kind_field = section.text("field");
        const Section table = section.section("kinds", true);
        for (const std::string& key : table.free_keys()) {
            input.material[key] = reading.material(table, key);
        }
    } else if (input.default_material.empty()) {
        section.mistake("material", "missing, expected a material, or a field and its kinds");
    }
    return input;
}

}  // namespace diurna
