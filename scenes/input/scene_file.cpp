#include "scenes/input/scene_file.hpp"

#include <fmt/format.h>

#include <cmath>

#include "materials/atmosphere/band_model.hpp"
#include "materials/base/document.hpp"
#include "materials/base/files.hpp"

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

/// Of every band and cube of the scene.
std::vector<SeenRange> seen_ranges(const Scene& scene) {
    std::vector<SeenRange> ranges;
    for (const ObserverInput& observer : scene.observers) {
        for (const std::string& name : observer.bands) {
            try {
                const Band band = named_band(scene.bands, name, bin_edges_um());
                ranges.push_back({name, band.from_um(), band.to_um()});
            } catch (const InputError&) {
                // Told of where the observer names it.
            }
        }
    }
    for (const CubeInput& cube : scene.cubes) {
        ranges.push_back({cube.name, cube.from_um, cube.to_um});
    }
    return ranges;
}

}  // namespace

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
    scene.textures = read_textures(root, reading);
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
    scene.plumes = read_plumes(root, reading);
    for (const Section& observer : root.sections("observer")) {
        scene.observers.push_back(read_observer(observer, scene.bands, scene.cubes));
    }
    if (scene.observers.empty()) {
        root.mistake("observer", "missing, expected at least one table [[observer]]");
    }
    check_table_bands(atmosphere, scene.air, seen_ranges(scene));
    document.finish();
    return scene;
}

}  // namespace diurna
