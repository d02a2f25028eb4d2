#include "scenes/world/land.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "materials/base/document.hpp"
#include "terrain/ground/rings.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/land_shapes.hpp"

namespace diurna {

namespace {

std::string known_material(const Section& section, const std::string& key,
                           const std::vector<std::string>& materials) {
    const std::string name = section.text(key);
    if (std::find(materials.begin(), materials.end(), name) == materials.end()) {
        section.mistake(key, fmt::format("no material \"{}\"", name),
                        did_you_mean(name, materials));
    }
    return name;
}

std::filesystem::path existing(const Section& section, const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / section.text("file");
    if (section.has("file") && !std::filesystem::is_regular_file(path)) {
        section.mistake("file", fmt::format("no such file: {}", path.string()));
    }
    return path;
}

/// East and north of a ring in the site's frame, at the ground's height.
std::vector<Eigen::Vector2d> local_ring(const std::vector<Geodetic>& ring, const Dem& dem,
                                        const Site& site) {
    const auto places = raster_places(dem, ring);
    std::vector<Eigen::Vector2d> local;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const double height = height_at(dem, places[i]);
        Geodetic corner = ring[i];
        corner.height = std::isnan(height) ? site.height : height;
        local.push_back(to_local(site, corner).head<2>());
    }
    return local;
}

bool on_raster(const Ring& ring, const Dem& dem) {
    const bool finite =
        std::all_of(ring.begin(), ring.end(), [](const auto& p) { return p.allFinite(); });
    return finite && ring.size() >= 3 && clipped(ring, dem.columns, dem.rows).size() >= 3;
}

}  // namespace

LandCoverInput read_land_cover(const Section& section, const std::filesystem::path& folder,
                               const std::vector<std::string>& materials) {
    LandCoverInput input;
    input.file = existing(section, folder);
    const Section table = section.section("material", true);
    for (const std::string& key : table.free_keys()) {
        int value = 0;
        const auto [end, problem] = std::from_chars(key.data(), key.data() + key.size(), value);
        if (problem != std::errc() || end != key.data() + key.size()) {
            table.mistake(key, "expected a class, a whole number");
            continue;
        }
        input.material[value] = known_material(table, key, materials);
    }
    return input;
}

ShapesInput read_shapes_input(const Section& section, const std::filesystem::path& folder,
                              const std::vector<std::string>& materials) {
    ShapesInput input;
    input.file = existing(section, folder);
    input.name = section.text_or("name", input.file.stem().string());
    input.largest_edge = section.number_or("largest_edge_m", 30.0, 1.0, 1e4);
    input.buildings = section.has("wall") || section.has("roof");
    if (input.buildings) {
        input.wall = known_material(section, "wall", materials);
        input.roof = section.has("roof") ? known_material(section, "roof", materials) : input.wall;
        input.height_field = section.text_or("height_field", "");
        input.default_height = section.number_or("height_m", input.default_height, 0.5, 1000.0);
        if (input.height_field.empty() && std::isnan(input.default_height)) {
            section.mistake("height_m", "missing, expected it or a height_field");
        }
        return input;
    }
    input.line_width = section.number_or("line_width_m", 6.0, 0.1, 1000.0);
    if (section.has("material")) {
        input.default_material = known_material(section, "material", materials);
    }
    if (section.has("field")) {
        input.kind_field = section.text("field");
        const Section table = section.section("kinds", true);
        for (const std::string& key : table.free_keys()) {
            input.material[key] = known_material(table, key, materials);
        }
    } else if (input.default_material.empty()) {
        section.mistake("material", "missing, expected a material, or a field and its kinds");
    }
    return input;
}

std::vector<GroundShape> ground_shapes(const std::vector<ShapesInput>& inputs, const Dem& dem,
                                       const Site& site) {
    std::vector<GroundShape> found;
    const auto add = [&](Ring ring, const ShapesInput& input, const std::string& material) {
        if (on_raster(ring, dem)) {
            found.push_back({{std::move(ring), input.largest_edge}, material});
        }
    };
    for (const ShapesInput& input : inputs) {
        if (input.buildings) continue;
        for (const LandShape& shape : read_shapes(input.file, input.kind_field)) {
            const auto kind = input.material.find(shape.kind);
            const std::string& material =
                kind != input.material.end() ? kind->second : input.default_material;
            if (material.empty()) continue;
            if (shape.line) {
                const auto line = local_ring(shape.ring, dem, site);
                add(raster_places(dem, site, ribbon(line, input.line_width)), input, material);
                continue;
            }
            add(raster_places(dem, shape.ring), input, material);
            for (const auto& hole : shape.hole) add(raster_places(dem, hole), input, "");
        }
    }
    return found;
}

std::vector<ShapeBuilding> shape_buildings(const std::vector<ShapesInput>& inputs, const Dem& dem,
                                           const Site& site, double tolerance) {
    std::vector<ShapeBuilding> buildings;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const ShapesInput& input = inputs[i];
        if (!input.buildings) continue;
        for (const LandShape& shape : read_shapes(input.file, "", input.height_field)) {
            const double height = std::isnan(shape.height) ? input.default_height : shape.height;
            if (shape.line || !(height > 0.0)) continue;
            double lowest = 1e9, highest = -1e9;
            const auto places = raster_places(dem, shape.ring);
            for (std::size_t k = 0; k < places.size(); ++k) {
                const double ground = height_at(dem, places[k]);
                const double up = to_local(site, {shape.ring[k].latitude_deg,
                                                  shape.ring[k].longitude_deg, ground})
                                      .z();
                lowest = std::isnan(up) ? up : std::min(lowest, up);
                highest = std::max(highest, up);
                if (std::isnan(lowest)) break;
            }
            if (std::isnan(lowest)) continue;
            // Walls reach into the ground, so that no light passes under them; the height counts
            // from the lowest corner.
            buildings.push_back({{.ring = local_ring(shape.ring, dem, site),
                                  .bottom = lowest - 1.0 - tolerance,
                                  .top = std::max(lowest + height, highest + 0.1),
                                  .largest_edge = std::max(1.0, input.largest_edge)},
                                 i});
        }
    }
    return buildings;
}

}  // namespace diurna
