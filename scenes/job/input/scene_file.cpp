#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/input/finer_edges.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/atmosphere/band_model.hpp"
#include "materials/matter/everyday_words.hpp"
#include "materials/matter/library_parts.hpp"
#include "materials/matter/read_library.hpp"
#include "materials/matter/read_material.hpp"
#include "render/picture/frame.hpp"
#include "scenes/job/input/index_reach.hpp"
#include "scenes/job/input/object_names.hpp"
#include "thermal/weather/sky_section.hpp"
#include "thermal/weather_file/weather_section.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// Throws InputError, in one line, for a column file: its keys would give a mistake each.
void refuse_column(const fs::path& file, const Confines& confines) {
    const Section root = Document::from_file(file, confines).root();
    for (const char* of_scene : {"terrain", "observer", "object", "sweep"}) {
        if (root.has(of_scene)) return;
    }
    const bool column = root.has("facet") || root.has("calibrate") ||
                        root.section("time", "span, start and steps").has("end");
    if (!column || !root.has("weather")) return;
    throw InputError(file.string(), "is a column file, expected a scene",
                     fmt::format("for a column use diurna column {}", file.string()));
}

constexpr const char* material_says =
    "a material of this name, with the keys of the section Materials";

std::optional<Site> read_site(const Section& section) {
    const bool north = section.has("latitude_deg"), east = section.has("longitude_deg");
    if (!north && !east) return std::nullopt;
    return Site{.latitude_deg = section.number(
                    "latitude_deg", "latitude north, WGS84; with longitude_deg", {-90.0, 90.0}),
                .longitude_deg = section.number(
                    "longitude_deg", "longitude east, WGS84; with latitude_deg", {-180.0, 180.0}),
                .height = section.number_or(
                    "height_m", "height of the frame's origin, in the raster's datum",
                    {std::nan(""), "height of the ground there"}, {-500.0, 9000.0})};
}

WeatherInput read_weather_input(const Section& section, const Reading& reading) {
    const std::vector<std::filesystem::path> files = section.files("file", weather_file_says);
    return {.file = files.empty() ? std::filesystem::path() : files.front(),
            .files = files,
            .options = read_weather_options(section, 0.5),
            .measured_over = read_measured_over(section, reading.materials.known)};
}

/// What becomes of it at other heights.
void read_heights(const Section& section, const AirInput& air, WeatherInput& weather) {
    weather.by_height = read_height_keys(section, air.sounding != nullptr, weather.options);
    if (weather.by_height.by_profile && air.vacuum) {
        section.mistake("lapse", "a vacuum has no profile");
    }
}

/// Names, and how finely the scene is sampled.
void read_about(const Section& about, Scene& scene) {
    const std::string folder =
        fs::absolute(scene.file).lexically_normal().parent_path().filename().string();
    scene.name = about.text_or("name", "name of the scene", {folder, "the name of its folder"});
    scene.title = about.text_or("title", "title of the report", {scene.name, "name"});
    scene.seed = static_cast<std::uint64_t>(about.integer_or(
        "seed", "seed of all random numbers except those of textures", 1, {0, 1 << 30}));
    scene.sky_rays = about.integer_or(
        "sky_rays", "rays to the sky per facet of the ground; near objects 2 to 64 times as many",
        64, {16, 4096});
    scene.object_sky_rays = about.integer_or(
        "object_sky_rays", "rays to the sky per facet of buildings and objects", 256, {16, 4096});
    scene.sun_samples = about.integer_or(
        "sun_samples",
        "rays to the sun's disc per facet and instant; four times as many near shadow edges", 4,
        {1, 256});
    scene.finer_edges = about.number_or(
        "finer_edges",
        "divides the edges of all facets: largest_edge_m, ground_edge_m, those of buildings and "
        "models; tolerance_m of the ground is divided by its square",
        1.0, {0.25, 16.0});
    scene.check_points = about.integer_or(
        "check_points",
        "places in pictures that are solved separately, each with its own sun, sky and "
        "surroundings "
        "by 4096 rays; the run reports how far its facets differ from them; 0: none",
        128, {0, 4096});
}

/// What may be skipped.
void read_tolerance(const Section& root, Scene& scene) {
    scene.tolerance_given = root.has("tolerance_K");
    scene.tolerance = root.number_or(
        "tolerance_K",
        "allowed rms error of a picture; facets that are neither visible nor thermally coupled to "
        "visible ones reuse a representative's temperature, the heat balance of the others ends "
        "within half of it, and tables of a picture and interreflections are computed to a tenth "
        "of it (1 to 10 mK); 0: every facet is solved. temperatures.nc names the representatives",
        0.1, {0.0, 10.0});
    scene.rounds = root.integer_or(
        "rounds",
        "how often `run` solves again, with more rays and finer edges, while its surface check "
        "finds more than tolerance_K",
        2, {0, 4});
    scene.exact = root.flag_or(
        "exact",
        "solve every facet and every shadow, model all dew, give each copy its own temperatures, "
        "and follow all reflected rays: tolerance_K and copies_alike_K count as 0",
        false);
    if (scene.exact) scene.tolerance = 0.0;
}

/// The scene's own materials, each of which may start from those above it.
void read_materials(const Section& materials, Scene& scene, Reading& reading) {
    scene.materials = default_material_library();
    for (const std::string& name : materials.free_keys()) {
        scene.materials.add(
            read_material(materials.section(name, material_says), scene.materials, name));
    }
    reading.materials.known = scene.materials.names();
    reading.materials.listed = "`diurna materials` lists the library";
    for (const auto& [word, name] : everyday_words()) {
        if (std::find(reading.materials.known.begin(), reading.materials.known.end(), word) !=
            reading.materials.known.end()) {
            continue;
        }
        reading.materials.instead[word] = "did you mean '" + name + "'?";
    }
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
                // Reported where the observer names it.
            }
        }
    }
    for (const CubeInput& cube : scene.cubes) {
        ranges.push_back({cube.name, cube.from_um, cube.to_um});
    }
    return ranges;
}

/// Of its pictures' files, except for band and instant.
std::string picture_name(const ObserverInput& observer) {
    Frame named;
    named.observer = observer.name;
    return frame_name(named, "");
}

/// How and when the scene is looked at, and studies of what is seen.
constexpr const char* of_pictures[] = {
    "observer",           "instrument",        "bands",       "cubes",     "labels",
    "output.compression", "signature",         "detection",   "crossover", "contrast",
    "sensitivity",        "uncertain",         "scene.title", "rounds",    "time.frames",
    "time.frame_every_s", "time.frames_at_sun"};

}  // namespace

namespace {

/// Materials and textures, each of which may name the other.
void read_surfaces(const Section& root, const Section& materials, Scene& scene, Reading& reading) {
    read_materials(materials, scene, reading);
    scene.textures = read_textures(root, reading);
    for (const TextureInput& texture : scene.textures) {
        reading.textures.known.push_back(texture.name);
    }
    for (const std::string& name : materials.free_keys()) {
        reading.texture(materials.section(name, material_says), reading.texture_uses.of_material,
                        name);
    }
}

/// Weather, sky and air, which share haze and heights. Returns the table of the air.
Section read_sky_and_air(const Section& root, Scene& scene, Reading& reading) {
    const Section weather =
        root.required_section("weather", "weather that drives the heat balance");
    scene.weather = read_weather_input(weather, reading);
    const Section sky = root.section("sky", sky_says);
    scene.sky = read_sky(sky);
    const Section atmosphere =
        root.section("atmosphere", "the atmosphere between surface and observer");
    scene.air = read_air(atmosphere);
    take_haze(scene.air, sky, scene.sky);
    for (const char* key : {"aerosol_380nm", "aerosol_500nm", "ozone_cm", "precipitable_water_cm",
                            "sun", "linke_turbidity", "longwave"}) {
        const bool idle = scene.air.drives_heat || scene.air.vacuum;
        if (idle && sky.has(key)) scene.idle_sky_keys.emplace_back(key);
    }
    read_heights(weather, scene.air, scene.weather);
    return atmosphere;
}

/// Throws for an observer whose pictures would have the names of another's.
void check_name(const Section& observer, const ObserverInput& input,
                const std::vector<ObserverInput>& others) {
    const auto same = std::find_if(others.begin(), others.end(), [&](const ObserverInput& other) {
        return picture_name(other) == picture_name(input);
    });
    if (same == others.end() || input.name.empty()) return;
    observer.mistake(
        "name", same->name == input.name
                    ? fmt::format("the observer name \"{}\" is used twice", input.name)
                    : fmt::format("the pictures of \"{}\" and \"{}\" would have the same names",
                                  same->name, input.name));
}

/// Everything that looks at the scene: bands, plumes in the way, radiometers, cameras.
void read_observers(const Section& root, Scene& scene, Reading& reading) {
    scene.bands = read_bands(root);
    scene.cubes = read_cubes(root);
    scene.plumes = read_plumes(root, reading.places);
    scene.radiometers = read_radiometers(root, reading.places);
    reading.object_names.erase("ground");  // it has no middle to look at
    ObserverReading seen_by{
        .places = reading.places,
        .bands = scene.bands,
        .cubes = scene.cubes,
        .terrain = scene.terrain,
        .trajectories = scene.trajectories,
        .time = scene.time,
        .site = scene.site,
        .objects = {.what = "object",
                    .known = {reading.object_names.begin(), reading.object_names.end()}}};
    add_objects(seen_by.objects, scene.terrain);
    for (const Section& observer : root.sections("observer", "a camera; at least one")) {
        ObserverInput input = read_observer(observer, seen_by);
        check_name(observer, input, scene.observers);
        scene.observers.push_back(std::move(input));
    }
    if (scene.observers.empty() && scene.radiometers.empty()) {
        root.mistake("observer",
                     "missing, expected at least one table [[observer]] or [[radiometer]]");
    }
    scene.instruments = read_instruments(root, scene.seed, scene.observers, scene.bands);
}

void read_studies(const Section& root, Scene& scene) {
    scene.signatures = read_signatures(root, scene.terrain, scene.bands, scene.time, scene.site);
    scene.detections = read_detections(root, scene.terrain, scene.instruments, scene.bands,
                                       scene.observers, scene.time, scene.site);
    scene.crossovers =
        read_crossovers(root, scene.terrain, scene.materials.names(), scene.bands, scene.observers);
    scene.contrasts =
        read_contrasts(root, scene.terrain, scene.materials.names(), scene.bands, scene.observers);
    scene.sensitivities = read_sensitivities(root, scene.terrain, scene.materials.names(),
                                             scene.bands, scene.observers, scene.time);
    scene.uncertain = read_uncertain_values(
        root, "an uncertain value of the scene; pictures get planes sigma.BAND");
    scene.sweep = read_sweep(
        root.section("sweep", "variants of the scene, which `diurna run` computes instead of it"));
}

/// Whether air and materials reach as far as the bands.
void check_ranges(const Section& atmosphere, const Section& materials, const Scene& scene) {
    const std::vector<SeenRange> seen = seen_ranges(scene);
    check_table_bands(atmosphere, scene.air, seen);
    for (const std::string& name : materials.free_keys()) {
        check_index_reach(materials.section(name, material_says),
                          scene.materials[scene.materials.find(name)], seen);
    }
}

}  // namespace

Scene read_scene(const Document& document) {
    const FilesRead opened;
    Scene scene;
    scene.file = document.file();
    note_file_read(scene.file);
    const Section root = document.root();
    scene.confines = document.confines();
    read_about(root.section("scene", "name and sampling of the scene"), scene);
    read_tolerance(root, scene);
    const Section site =
        root.section("site", "origin of the east-north-up frame; default: centre of the raster");
    scene.site = read_site(site);
    const Section terrain =
        root.required_section("terrain", "elevation of the ground and its materials");
    ElevationInput elevation = read_elevation_keys(terrain, scene.site);
    divide_tolerances(scene.finer_edges, elevation);
    Reading reading{.places{site, terrain, scene.site, elevation}};
    const Section materials = root.section(
        "material",
        "additional materials of the scene; one with a name of the library replaces that material");
    read_surfaces(root, materials, scene, reading);
    scene.time = read_time(root.required_section("time", "span, steps and pictures"), scene.site);
    scene.trajectories = read_trajectories(root, scene.time, reading.places);
    for (const TrajectoryInput& way : scene.trajectories) {
        reading.trajectories.known.push_back(way.name);
    }
    scene.terrain = read_terrain(terrain, root, reading, elevation);
    divide_edges(scene.finer_edges, scene.terrain);
    for (ObjectInput& object : scene.terrain.objects) {
        if (scene.exact) object.alike_within = 0.0;
    }
    const Section atmosphere = read_sky_and_air(root, scene, reading);
    scene.output =
        read_output(root.section("output", "additional output besides temperatures and pictures"));
    scene.labels = read_labels(root.section("labels", "pictures and labels for machine learning"));
    read_observers(root, scene, reading);
    read_studies(root, scene);
    scene.texture_uses = std::move(reading.texture_uses);
    check_ranges(atmosphere, materials, scene);
    document.finish();
    scene.elevation = reading.places.elevation();
    scene.files = opened.files();
    scene.said = document.text_without({});
    scene.said_but_for_pictures = document.text_without(of_pictures);
    return scene;
}

Document scene_document(const fs::path& file, const std::vector<std::string>& settings,
                        const Confines& confines) {
    Document document = Document::from_file(file, confines);
    document.name_tables("crossover", {"first", "second"});
    document.name_tables("signature", {"object"});
    document.name_tables("detection", {"object"});
    document.name_tables("contrast", {});
    document.name_tables("sensitivity", {});
    apply_settings(document, settings, MaterialTables::by_name);
    return document;
}

Scene read_scene(const fs::path& file, const std::vector<std::string>& settings,
                 bool allow_outside) {
    const Confines confines = confines_of(file, allow_outside);
    refuse_column(file, confines);
    return read_scene(scene_document(file, settings, confines));
}

}  // namespace diurna
