#include "scenes/input/scene_file.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "materials/base/document.hpp"
#include "materials/base/files.hpp"
#include "materials/base/units.hpp"
#include "scenes/input/checked_names.hpp"
#include "scenes/input/read_air.hpp"
#include "scenes/input/read_observer.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

Instant moment(const Section& section, const std::string& key) {
    try {
        return parse_instant(section.moment(key), key);
    } catch (const InputError& error) {
        section.mistake(key, error.mistakes().front().problem);
        return {};
    }
}

std::optional<Site> read_site(const Section& section) {
    if (!section.has("latitude_deg") && !section.has("longitude_deg")) return std::nullopt;
    return Site{.latitude_deg = section.number("latitude_deg", -90, 90),
                .longitude_deg = section.number("longitude_deg", -180, 180),
                .height = section.number_or("height_m", std::nan(""), -500, 9000)};
}

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
        const std::string name = reading.object(object);
        terrain.objects.push_back(read_object_input(object, reading.folder, reading.materials));
        terrain.objects.back().name = name;
    }
    for (const std::string& tile : section.texts_or("more_tiles", {})) {
        terrain.tiles.push_back(reading.folder / tile);
        if (!fs::is_regular_file(terrain.tiles.back())) {
            section.mistake("more_tiles", fmt::format("no such file: {}", tile));
        }
    }
    if (section.has("land_cover")) {
        terrain.land_cover =
            read_land_cover(section.section("land_cover"), reading.folder, reading.materials);
    }
    for (const Section& shapes : root.sections("shapes")) {
        terrain.shapes.push_back(read_shapes_input(shapes, reading.folder, reading.materials));
    }
    return terrain;
}

WeatherInput read_weather_input(const Section& section, const Reading& reading) {
    return {.file = reading.file(section, "file"),
            .interval = section.word_or("interval", "instant", {"start", "end", "instant"}),
            .wind_height = section.number_or("wind_height_m", 10.0, 0.5, 200),
            .air_height = section.number_or("air_height_m", 2.0, 0.1, 200)};
}

TimeInput read_time(const Section& section) {
    TimeInput time;
    time.start = moment(section, "start");
    time.duration = 3600.0 * section.number_or("duration_h", 24.0, 1.0, 24.0);
    time.step = section.number_or("step_s", 600.0, 1.0, 3600.0);
    time.frame_every = section.number_or("frame_every_s", 3600.0, 1.0, 86400.0);
    for (const auto& [key, value] :
         {std::pair{"step_s", time.step}, {"frame_every_s", time.frame_every}}) {
        const double count = time.duration / value;
        if (std::abs(count - std::round(count)) > 1e-9) {
            section.mistake(key, fmt::format("{:g} s does not divide the duration of {:g} s evenly",
                                             value, time.duration));
        }
    }
    const double steps = time.frame_every / time.step;
    if (std::abs(steps - std::round(steps)) > 1e-9) {
        section.mistake("frame_every_s",
                        fmt::format("{:g} s is not a multiple of the step of {:g} s",
                                    time.frame_every, time.step));
    }
    return time;
}

}  // namespace

std::vector<std::string> object_names(const Scene& scene) {
    std::vector<std::string> names{"ground"};
    for (const auto& polygon : scene.terrain.polygons) names.push_back(polygon.name);
    for (const auto& building : scene.terrain.buildings) names.push_back(building.name);
    for (const auto& object : scene.terrain.objects) names.push_back(object.name);
    return names;
}

Scene read_scene(const fs::path& file, const std::vector<std::string>& settings) {
    const std::string text = read_text(file, 16u << 20);
    Document document = Document::from_text(text, file.string());
    for (const std::string& setting : settings) document.set(setting);
    const Section root = document.root();

    Scene scene;
    scene.file = file;
    scene.materials = default_material_library();
    const Section own_materials = root.section("material");
    for (const std::string& name : own_materials.free_keys()) {
        scene.materials.add(
            read_material(own_materials.section(name), scene.materials, file.parent_path(), name));
    }
    Reading reading{.folder = file.parent_path(),
                    .materials = scene.materials.names(),
                    .object_names = {"ground"}};
    scene.textures = read_textures(root, reading.folder, reading.materials);
    scene.texture_uses = read_texture_uses(root, scene.textures);

    const Section about = root.section("scene");
    scene.name = about.text_or("name", file.parent_path().filename().string());
    scene.title = about.text_or("title", scene.name);
    scene.seed = static_cast<std::uint64_t>(about.integer_or("seed", 1, 0, 1 << 30));
    scene.sky_rays = about.integer_or("sky_rays", 64, 16, 4096);
    scene.object_sky_rays = about.integer_or("object_sky_rays", 256, 16, 4096);
    scene.sun_samples = about.integer_or("sun_samples", 4, 1, 256);
    scene.site = read_site(root.section("site"));
    const Section terrain = root.section("terrain", true);
    scene.terrain = read_terrain(terrain, root, reading);
    if (terrain.has("radius_m")) {
        scene.terrain.reading.radius = terrain.number("radius_m", 10.0, 2e5);
        if (scene.site) {
            scene.terrain.reading.centre =
                Geodetic{scene.site->latitude_deg, scene.site->longitude_deg, 0.0};
        } else {
            terrain.mistake("radius_m", "a radius needs a [site] to be around");
        }
    }
    scene.weather = read_weather_input(root.section("weather", true), reading);
    const Section atmosphere = root.section("atmosphere");
    scene.air = read_air(atmosphere, reading);
    scene.time = read_time(root.section("time", true));
    scene.bands = read_bands(root, reading.folder);
    scene.cubes = read_cubes(root);
    scene.plumes = read_plumes(root, reading.folder);
    for (const Section& observer : root.sections("observer")) {
        scene.observers.push_back(read_observer(observer, scene));
    }
    if (scene.observers.empty()) {
        root.mistake("observer", "missing, expected at least one table [[observer]]");
    }
    check_table_bands(atmosphere, scene);
    document.finish();
    return scene;
}

}  // namespace diurna
