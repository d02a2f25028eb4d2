#include "scenes/input/read_terrain.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "materials/base/units.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// Corners of a rectangle [east, north, length, width, heading of its length].
std::vector<Eigen::Vector2d> rectangle(const std::vector<double>& spec) {
    const double heading = radians(spec[4]);
    const Eigen::Vector2d centre(spec[0], spec[1]);
    const Eigen::Vector2d along =
        0.5 * spec[2] * Eigen::Vector2d(std::sin(heading), std::cos(heading));
    const Eigen::Vector2d right =
        0.5 * spec[3] * Eigen::Vector2d(std::cos(heading), -std::sin(heading));
    return {centre - along - right, centre - along + right, centre + along + right,
            centre + along - right};
}

GroundPolygon read_polygon(const Section& section, Reading& reading) {
    GroundPolygon polygon;
    polygon.name = reading.object(section);
    if (section.has("material")) polygon.material = reading.material(section, "material");
    polygon.largest_edge = section.number_or("largest_edge_m", 30.0, 1.0, 1e4);
    if (section.has("rectangle_m")) {
        const std::vector<double> spec = section.numbers("rectangle_m", 5);
        if (!(spec[2] > 0.0 && spec[3] > 0.0)) {
            section.mistake("rectangle_m",
                            "expected [east, north, length > 0, width > 0, heading_deg]");
        }
        polygon.ring = rectangle(spec);
    } else {
        for (const auto& corner : section.rows("ring_m", 2, 3)) {
            polygon.ring.emplace_back(corner[0], corner[1]);
        }
    }
    return polygon;
}

Building read_building(const Section& section, Reading& reading) {
    const std::string wall = reading.material(section, "wall");
    return {.name = reading.object(section),
            .place = place(section, "place_m"),
            .width = section.number("width_m", 0.5, 1000),
            .depth = section.number("depth_m", 0.5, 1000),
            .height = section.number("height_m", 0.5, 500),
            .heading_deg = section.number_or("heading_deg", 180.0, -360, 360),
            .wall = wall,
            .front = reading.material(section, "front", wall),
            .roof = reading.material(section, "roof", wall)};
}

}  // namespace

TerrainInput read_terrain(const Section& section, const Section& root, Reading& reading) {
    TerrainInput terrain;
    terrain.elevation = reading.file(section, "elevation");
    terrain.tolerance = section.number_or("tolerance_m", 1.0, 0.0, 1000.0);
    if (section.has("coarsest_m")) terrain.coarsest = section.number("coarsest_m", 0.0, 1000.0);
    terrain.default_material = reading.material(section, "material");
    const std::string voids = section.word_or("voids", "refuse", {"refuse", "fill"});
    terrain.reading.voids = voids == "fill" ? VoidPolicy::fill : VoidPolicy::refuse;
    const std::string mesh = section.word_or("mesh", "network", {"network", "grid", "auto"});
    terrain.mesh = mesh == "grid"   ? TerrainInput::Mesh::grid
                   : mesh == "auto" ? TerrainInput::Mesh::grid_where_it_fits
                                    : TerrainInput::Mesh::network;
    terrain.refraction = section.number_or("refraction", 0.0, 0.0, 0.5);
    const std::map<std::string, double> units{
        {"m", 1.0}, {"dm", 0.1}, {"cm", 0.01}, {"ft", 0.3048}, {"us_ft", 1200.0 / 3937.0}};
    const std::string unit =
        section.word_or("height_unit", "file", {"file", "m", "dm", "cm", "ft", "us_ft"});
    if (const auto known = units.find(unit); known != units.end()) {
        terrain.reading.unit = known->second;
    }
    terrain.reading.geoid = section.word_or("vertical_datum", "file", {"file", "egm96"}) == "egm96";
    for (const Section& rule : section.sections("rule")) {
        const auto slope = rule.numbers_or("slope_deg", {0.0, 90.0}, 2);
        const auto height = rule.numbers_or("height_m", {-1e4, 1e4}, 2);
        if (!(slope[0] < slope[1]))
            rule.mistake("slope_deg", "expected [least, most] in ascending order");
        if (!(height[0] < height[1]))
            rule.mistake("height_m", "expected [least, most] in ascending order");
        terrain.rules.push_back({.material = reading.material(rule, "material"),
                                 .least_slope_deg = slope[0],
                                 .most_slope_deg = slope[1],
                                 .least_height = height[0],
                                 .most_height = height[1]});
    }
    for (const Section& polygon : root.sections("ground")) {
        terrain.polygons.push_back(read_polygon(polygon, reading));
    }
    for (const Section& building : root.sections("building")) {
        terrain.buildings.push_back(read_building(building, reading));
    }
    for (const Section& object : root.sections("object")) {
        terrain.objects.push_back(read_object(object, reading));
    }
    for (const std::string& tile : section.texts_or("more_tiles", {})) {
        terrain.tiles.push_back(reading.folder / tile);
        if (!fs::is_regular_file(terrain.tiles.back())) {
            section.mistake("more_tiles", fmt::format("no such file: {}", tile));
        }
    }
    if (section.has("land_cover")) {
        terrain.land_cover = read_land_cover(section.section("land_cover"), reading);
    }
    for (const Section& shapes : root.sections("shapes")) {
        terrain.shapes.push_back(read_shapes_input(shapes, reading));
    }
    return terrain;
}

}  // namespace diurna
