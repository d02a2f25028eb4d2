#include "scenes/job/input/read_land.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

/// By its name: building:levels, num_floors, STOREYS; not storeys_m, which is in metres.
bool counts_storeys(const std::string& field) {
    const std::string name = small_letters(field);
    if (name.ends_with("_m")) return false;
    for (const char* word :
         {"level", "storey", "storeys", "stories", "floors", "etage", "geschoss"}) {
        if (name.find(word) != std::string::npos) return true;
    }
    return false;
}

void read_buildings(const Section& section, const Reading& reading, ShapesInput& input) {
    input.wall = section.name("wall", "material of the buildings' walls", reading.materials);
    input.roof = section.name_or("roof", "material of their flat roofs", {input.wall, "wall"},
                                 reading.materials);
    input.kind = class_of(section, "building");
    input.height_field = section.text_or("height_field",
                                         "field of the file with a building's height: metres, or a "
                                         "text with its unit (\"12.5 m\", \"41 ft\")",
                                         "");
    const double storey = section.number_or(
        "level_height_m",
        "height of a storey, if height_field is a number of storeys (building:levels)",
        {std::nan(""), "none"}, {0.5, 20.0});
    if (!std::isnan(storey)) {
        input.level_height = storey;
    } else if (counts_storeys(input.height_field)) {
        section.mistake("height_field",
                        fmt::format("found '{}', a number of storeys; expected a height in metres, "
                                    "or level_height_m = 3.0 as well",
                                    input.height_field));
    }
    input.default_height = section.number_or(
        "height_m", "height of buildings without a height_field; otherwise they are skipped",
        input.default_height, {0.5, 1000.0});
    if (input.height_field.empty() && std::isnan(input.default_height)) {
        section.mistake("height_m", "missing, expected height_m or height_field");
    }
}

void read_ground_shapes(const Section& section, const Reading& reading, ShapesInput& input) {
    input.line_width =
        section.number_or("line_width_m", "width of lines, which become roads", 6.0, {0.1, 1000.0});
    input.default_material = section.name_or(
        "material", "material of shapes whose kind is not in `kinds`; without it they are skipped",
        "", reading.materials);
    if (section.has("field")) {
        input.kind_field = section.text("field", "field of the file with a shape's kind");
        const Section table =
            section.required_section("kinds", "material of each kind of the field");
        for (const std::string& key : table.free_keys()) {
            input.material[key] =
                table.name(key, "material of shapes of this kind", reading.materials);
        }
    } else if (input.default_material.empty()) {
        section.mistake("material", "missing, expected a material, or a field and its kinds");
    }
}

}  // namespace

LandCoverInput read_land_cover(const Section& section, const Reading& reading) {
    LandCoverInput input;
    input.file = section.file("file", "raster of classes, in a format that GDAL reads");
    const Section table =
        section.required_section("material", "materials of classes, by class number");
    for (const std::string& key : table.free_keys()) {
        int value = 0;
        const auto [end, problem] = std::from_chars(key.data(), key.data() + key.size(), value);
        if (problem != std::errc() || end != key.data() + key.size()) {
            table.mistake(key, "expected a class, a whole number");
            continue;
        }
        input.material[value] =
            table.name(key, "material of ground of this class", reading.materials);
    }
    if (table.free_keys().empty()) {
        section.mistake("material", "names no class, expected at least one: 1 = \"sand\"");
    }
    return input;
}

ShapesInput read_shapes_input(const Section& section, const Reading& reading) {
    ShapesInput input;
    input.file = section.file(
        "file", "GeoJSON, Shapefile (also zipped), GeoPackage, KML or KMZ, FlatGeobuf");
    input.layer =
        section.text_or("layer", "layer of a file with several layers, or \"*\" for all", "");
    input.confines = section.confines();
    input.name = section.text_or("name", "name of the object that contains its buildings",
                                 {input.file.stem().string(), "the file's name"});
    input.largest_edge = section.number_or("largest_edge_m", "largest edge of the triangles inside",
                                           30.0, {1.0, 1e4});
    input.buildings = section.has("wall") || section.has("roof");
    if (input.buildings) {
        read_buildings(section, reading, input);
    } else {
        read_ground_shapes(section, reading, input);
    }
    return input;
}

}  // namespace diurna
