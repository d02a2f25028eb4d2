#include "scenes/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "materials/document.hpp"
#include "materials/files.hpp"
#include "materials/units.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// What the parts of a scene file need to know of the rest of it.
struct Reading {
    fs::path folder;  // relative names of files start here
    std::vector<std::string> materials;
    std::set<std::string> object_names;

    fs::path file(const Section& section, const std::string& key) const {
        const std::string name = section.text(key);
        const fs::path path = fs::path(name).is_absolute() ? fs::path(name) : folder / name;
        if (!name.empty() && !fs::is_regular_file(path)) {
            section.mistake(key, fmt::format("no such file: {}", path.string()));
        }
        return path;
    }
    std::string material(const Section& section, const std::string& key,
                         const std::string& fallback = "") const {
        if (!section.has(key)) {
            if (fallback.empty()) section.mistake(key, "missing, expected a material's name");
            return fallback;
        }
        const std::string name = section.text(key);
        if (std::find(materials.begin(), materials.end(), name) == materials.end()) {
            section.mistake(key, fmt::format("no material \"{}\"", name),
                            did_you_mean(name, materials));
        }
        return name;
    }
    std::string object(const Section& section) {
        const std::string name = section.text("name");
        if (!name.empty() && !object_names.insert(name).second) {
            section.mistake("name", fmt::format("a second object named \"{}\"", name));
        }
        return name;
    }
};

Eigen::Vector2d place(const Section& section, const std::string& key) {
    const std::vector<double> at = section.numbers(key, 2);
    return {at[0], at[1]};
}

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

/// The table of paths, its own mistakes told where the scene names it.
void read_table(const Section& section, const Reading& reading, AirInput& air) {
    air.table_file = reading.file(section, "table");
    if (air.vacuum || air.drives_heat) {
        section.mistake("table", air.vacuum
                                     ? "a vacuum has no table of paths"
                                     : "a table has no fluxes for drives_heat = true to take");
    }
    if (!fs::is_regular_file(air.table_file)) return;
    try {
        air.table = read_path_table(air.table_file);
    } catch (const InputError& error) {
        section.mistake("table", error.mistakes().front().line());
    } catch (const std::runtime_error& error) {
        section.mistake("table", fmt::format("{}: {}", air.table_file.string(), error.what()));
    }
}

/// Every band needs its bins in the table, and no scattered sun: the table has none.
void check_table_bands(const Section& section, const Scene& scene) {
    if (!scene.air.table) return;
    constexpr double least_um = 3.0;
    const TableSpan span = table_span(*scene.air.table);
    const auto check = [&](const std::string& name, double from_um, double to_um) {
        if (from_um < least_um) {
            section.mistake("table", fmt::format("band {} begins at {:g} um: a table has no "
                                                 "scattered sun, expected {:g} um or more",
                                                 name, from_um, least_um));
        } else if (from_um < span.least_um || to_um > span.most_um) {
            section.mistake("table",
                            fmt::format("band {} needs {:g} to {:g} um, the table has {:.4g} to "
                                        "{:.4g}",
                                        name, from_um, to_um, span.least_um, span.most_um));
        }
    };
    for (const ObserverInput& observer : scene.observers) {
        for (const std::string& name : observer.bands) {
            try {
                const Band band = named_band(scene.bands, name, bin_edges_um());
                check(name, band.from_um(), band.to_um());
            } catch (const InputError&) {
                // Told of where the observer names it.
            }
        }
    }
    for (const CubeInput& cube : scene.cubes) check(cube.name, cube.from_um, cube.to_um);
}

AirInput read_air(const Section& section, const Reading& reading) {
    std::vector<std::string> profiles = afgl_profile_names();
    profiles.push_back("vacuum");
    AirInput air;
    air.profile = section.word_or("profile", air.profile, profiles);
    air.vacuum = air.profile == "vacuum";
    air.aerosol = section.word_or("aerosol", air.aerosol, aerosol_names());
    air.visibility_km = section.number_or("visibility_km", air.visibility_km, 0.05, 300);
    air.co2_ppm = section.number_or("co2_ppm", air.co2_ppm, 0, 10000);
    air.cloud_base_km = section.number_or("cloud_base_km", air.cloud_base_km, 0.05, 15);
    air.drives_heat = section.flag_or("drives_heat", air.drives_heat);
    if (air.vacuum && air.drives_heat) {
        section.mistake("drives_heat",
                        "a vacuum has neither sky nor air to drive the heat balance");
    }
    if (section.has("table")) read_table(section, reading, air);
    return air;
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

/// A field of view, or a focal plane behind a lens, or the width of a picture of parallel rays.
void read_projection(const Section& section, ObserverInput& observer) {
    const std::vector<std::string> names = {"pinhole", "equidistant", "equisolid", "panorama",
                                            "orthographic"};
    const std::string name = section.word_or("projection", "pinhole", names);
    const auto found = std::find(names.begin(), names.end(), name);
    observer.projection = static_cast<Projection>(found - names.begin());
    if (observer.projection == Projection::orthographic) {
        observer.picture_width = section.number("picture_width_m", 0.01, 2e5);
    } else if (section.has("focal_length_mm")) {
        const double focal_length = section.number("focal_length_mm", 0.1, 1e5);
        const double pitch = section.number("pixel_pitch_um", 0.1, 1e4);
        observer.horizontal_fov_deg = field_of_view_deg(observer.width, pitch, focal_length);
        if (observer.projection != Projection::pinhole || section.has("horizontal_fov_deg")) {
            section.mistake("focal_length_mm", "is for pinhole cameras without horizontal_fov_deg");
        } else if (!(observer.horizontal_fov_deg <= 150.0)) {
            section.mistake("focal_length_mm",
                            fmt::format("makes a field of view of {:.1f} degrees, expected at most "
                                        "150",
                                        observer.horizontal_fov_deg));
        }
    } else {
        const bool pinhole = observer.projection == Projection::pinhole;
        observer.horizontal_fov_deg = section.number_or(
            "horizontal_fov_deg", pinhole ? 20.0 : 180.0, 0.01, pinhole ? 150.0 : 360.0);
    }
}

ObserverInput read_observer(const Section& section, const Scene& scene) {
    ObserverInput observer;
    observer.name = section.text("name");
    observer.place = place(section, "place_m");
    observer.height_above_ground = section.number("height_above_ground_m", 0.1, 50000);
    if (section.has("look_at_m")) {
        observer.look_at = place(section, "look_at_m");
    } else {
        observer.azimuth_deg = section.number("azimuth_deg", -360, 360);
        observer.elevation_deg = section.number("elevation_deg", -90, 90);
    }
    observer.roll_deg = section.number_or("roll_deg", 0.0, -180, 180);
    observer.width = section.integer_or("width", 640, 1, 16384);
    observer.height = section.integer_or("height", 512, 1, 16384);
    read_projection(section, observer);
    observer.samples = section.integer_or("samples", 16, 1, 1024);
    observer.terms = section.flag_or("terms", false);
    observer.bands = section.texts_or("bands", {"3-5", "8-12"});
    for (const std::string& band : observer.bands) {
        try {
            named_band(scene.bands, band);
        } catch (const InputError& error) {
            section.mistake("bands", error.mistakes().front().problem,
                            error.mistakes().front().hint);
        }
    }
    observer.cubes = section.texts_or("cubes", {});
    std::vector<std::string> cubes;
    for (const CubeInput& cube : scene.cubes) cubes.push_back(cube.name);
    for (const std::string& cube : observer.cubes) {
        if (std::find(cubes.begin(), cubes.end(), cube) == cubes.end()) {
            section.mistake("cubes", fmt::format("no cube \"{}\" in [[cubes]]", cube),
                            did_you_mean(cube, cubes));
        }
    }
    return observer;
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
