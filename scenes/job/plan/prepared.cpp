#include "scenes/job/plan/prepared.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "materials/atmosphere/band_model.hpp"
#include "materials/base/error.hpp"
#include "materials/base/files_read.hpp"
#include "materials/matter/passed_light.hpp"
#include "materials/matter/spectrum_notes.hpp"
#include "materials/radiation/band.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/job/world/air.hpp"
#include "scenes/job/world/build_world.hpp"
#include "scenes/job/world/elevation.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/measured_albedo.hpp"
#include "scenes/job/world/plumes.hpp"
#include "scenes/job/world/scene_weather.hpp"
#include "scenes/job/world/stepping.hpp"
#include "scenes/job/world/textures.hpp"
#include "terrain/raster/dem.hpp"
#include "thermal/weather/weather_warnings.hpp"

namespace diurna {

namespace {

/// Of materials whose spectra end short of what heat or the pictures need of them.
std::vector<std::string> notes_on_spectra(const Scene& scene, const World& world) {
    std::vector<Band> bands;
    const auto add = [&](const Band& band) {
        const bool there = std::any_of(bands.begin(), bands.end(),
                                       [&](const Band& b) { return b.name == band.name; });
        if (!there) bands.push_back(band);
    };
    for (const ObserverInput& observer : scene.observers) {
        for (const std::string& name : observer.bands) {
            add(named_band(scene.bands, name, bin_edges_um()));
        }
    }
    for (const CubeInput& cube : scene.cubes) add(flat_band(cube.name, cube.from_um, cube.to_um));
    const FacetSet& surfaces = world.surfaces();
    std::vector<std::string> notes;
    for (const MaterialId id : std::set(surfaces.material.begin(), surfaces.material.end())) {
        for (std::string& note : spectrum_notes(scene.materials[id], bands)) {
            const bool reported = std::find(notes.begin(), notes.end(), note) != notes.end();
            if (!reported) notes.push_back(std::move(note));
        }
    }
    return notes;
}

/// Of grey pictures in which most programs see little.
std::vector<std::string> notes_on_grey(const Scene& scene) {
    if (scene.labels.bits != 16 || scene.observers.empty()) return {};
    return {
        "grey pictures in images/ have 16 bits (temperatures: 0.01 K per count); most viewers show "
        "them nearly black, and programs that read only the upper 8 bits get 2 to 10 grey levels: "
        "stretch display_counts (annotations.json) to black and white, or set labels.bits = 8"};
}

/// Heights over the ellipsoid on ground whose own zero nobody has reported.
std::vector<std::string> notes_on_heights(const Scene& scene) {
    std::vector<std::string> notes;
    if (scene.terrain.elevation.reading.geoid) return notes;
    const auto look = [&](const char* kind, const std::string& name, HeightOver over) {
        if (over != HeightOver::ellipsoid) return;
        notes.push_back(
            fmt::format("heights above the ellipsoid of the {} \"{}\" use the same zero as the "
                        "elevation data; if the elevation is above sea level, set "
                        "terrain.vertical_datum = \"egm96\" (difference up to 107 m)",
                        kind, name));
    };
    for (const auto& way : scene.trajectories) look("trajectory", way.name, way.heights);
    for (const auto& one : scene.observers) look("observer", one.name, one.stands.over);
    for (const auto& one : scene.terrain.objects) look("object", one.name, one.stands.over);
    for (const auto& one : scene.plumes) look("plume", one.name, one.stands.over);
    for (const auto& one : scene.radiometers) look("radiometer", one.name, one.stands.over);
    return notes;
}

/// Days without a picture where the sun says when to take them.
std::vector<std::string> notes_on_frames(const Scene& scene) {
    std::vector<std::string> notes;
    if (!scene.time.frames_note.empty()) notes.push_back("pictures: " + scene.time.frames_note);
    for (const ObserverInput& observer : scene.observers) {
        if (observer.frames_note.empty()) continue;
        notes.push_back(fmt::format("pictures of \"{}\": {}", observer.name, observer.frames_note));
    }
    return notes;
}

/// Ground lower than air, sun and weather are known for: the bottom of a sea, or voids that nobody
/// has declared. The Dead Sea's shore lies at -430 m.
void refuse_depths(const Dem& dem) {
    constexpr float lowest = -500.0f;
    for (const float height : dem.height) {
        if (!(height < lowest)) continue;  // true of voids, too
        throw InputError(
            dem.source,
            fmt::format("found a height of {:.0f} m, expected {:.0f} m or more", height, lowest),
            "sea-bottom depths are not ground: declare posts without elevation as voids");
    }
    for (const DemDetail& detail : dem.detail) refuse_depths(detail.raster);
}

/// Throws InputError for one below the ground or inside a body.
std::vector<PlacedRadiometer> placed_radiometers(const Scene& scene, const Dem& dem,
                                                 const World& world, const RayScene& rays) {
    std::vector<PlacedRadiometer> placed;
    for (const RadiometerInput& input : scene.radiometers) {
        const Eigen::Vector3d at = stand_point(world, dem, input.place, input.stands, input.where);
        try {
            check_observer({.name = input.name, .position = at}, world.facets, rays,
                           world.ground_facets, world.objects);
        } catch (const InputError& error) {
            throw InputError(input.where,
                             fmt::format("radiometer \"{}\" sees no surface: {}", input.name,
                                         error.mistakes().front().problem),
                             "raise it or move it to an open place");
        }
        placed.push_back({input, at});
    }
    return placed;
}

}  // namespace

LightOfInstant light_at(const Prepared& prepared, Instant instant) {
    return prepared.light->at(prepared.scene, prepared.world, instant);
}

Prepared moved(const Prepared& prepared, const MoverPoses& poses) {
    return moving(prepared, poses, {}, 0.0);
}

Prepared moving(const Prepared& prepared, const MoverPoses& poses,
                const std::vector<Motion>& motions, double reach) {
    World world = moved(prepared.world, poses);
    FacetMotion motion;
    if (reach > 0.0) {
        const FacetSet& begun = prepared.world.facets;
        const auto places = [&](double seconds) {
            return moved(prepared.world, begun, gone_on(poses, motions, seconds)).vertex;
        };
        motion = {places(-reach), places(reach)};
    }
    RayScene rays(world.facets, passed_light(prepared.scene.materials), world.copies, motion);
    return {prepared.parts,
            std::make_shared<const ScenePlace>(ScenePlace{std::move(world), std::move(rays)})};
}

Prepared with_pictures(const Prepared& prepared, std::vector<ObserverInput> observers,
                       std::vector<Sequence> sequences) {
    auto parts = std::make_shared<SceneParts>(*prepared.parts);
    parts->scene.observers = std::move(observers);
    parts->sequences = std::move(sequences);
    return {std::move(parts), prepared.place};
}

Prepared prepare(Scene scene) {
    const FilesRead opened;
    const Dem dem = elevation_of(scene);
    scene.elevation.reset();  // which may be large
    refuse_depths(dem);
    World world = build_world(scene, dem);
    RayScene rays(world.facets, passed_light(scene.materials), world.copies);
    Weather measured = measured_weather(scene, world);
    std::vector<Mistake> implausible = weather_warnings(
        measured, world.site, scene.time.start, later(scene.time.start, scene.time.duration),
        scene.file.string() + ": weather.file");
    Weather weather = scene_weather(scene, world, std::move(measured));
    Movement movement_of_objects =
        movement(scene, dem, world, frames_of(scene), scene_steps(scene));
    if (scene.time.spin_up == SpanStart::steady && movement_of_objects.stage.size() > 1) {
        throw InputError(scene.file.string() + ": time.spin_up",
                         "found \"steady\" with objects that move within the span",
                         "\"steady\" solves the balance of a mean day, without moving objects; use "
                         "\"periodic\"");
    }
    std::vector<Sequence> pictures = sequences(scene, dem, world, rays, movement_of_objects);
    for (const Sequence& sequence : pictures) {
        check_table(scene, world, sequence.pose);
        if (!sequence.note.empty()) world.notes.push_back(sequence.note);
    }
    std::vector<Plume> plumes;
    for (const PlumeInput& plume : scene.plumes) {
        const std::string where = fmt::format("{}: plume \"{}\"", scene.file.string(), plume.name);
        plumes.push_back(
            plume_at(plume, stand_point(world, dem, plume.place, plume.stands, where)));
    }
    std::vector<PlacedRadiometer> radiometers = placed_radiometers(scene, dem, world, rays);
    std::vector<std::string> notes = dem.notes;
    notes.insert(notes.end(), world.notes.begin(), world.notes.end());
    for (std::string& note : lay_textures(scene, world)) notes.push_back(std::move(note));
    for (std::string& note : notes_on_frames(scene)) notes.push_back(std::move(note));
    for (std::string& note : notes_on_heights(scene)) notes.push_back(std::move(note));
    for (std::string& note : notes_on_grey(scene)) notes.push_back(std::move(note));
    Plan plan = make_plan(scene, world, weather, &rays, pictures,
                          std::max<std::size_t>(1, movement_of_objects.stage.size()), plumes);
    for (std::string& note : table_notes(scene)) notes.push_back(std::move(note));
    if (scene.air.sounding) {
        const std::vector<std::string>& repaired = scene.air.sounding->notes;
        notes.insert(notes.end(), repaired.begin(), repaired.end());
    }
    if (world.filled_facets > 0) {
        std::size_t voids = dem.voids;
        for (const DemDetail& detail : dem.detail) voids += detail.raster.voids;
        notes.push_back(fmt::format(
            "{} of {} elevation posts are void and were interpolated: {} of {} ground facets",
            voids, world.posts, world.filled_facets, world.ground_facets));
    }
    if (std::string note = height_note(scene, world, weather); !note.empty()) {
        notes.push_back(std::move(note));
    }
    for (std::string& note : notes_on_spectra(scene, world)) notes.push_back(std::move(note));
    if (const double longest = movement_of_objects.longest_move; longest > 0.0) {
        notes.push_back(fmt::format(
            "moving objects: the heat balance keeps them at rest in {} stages and moves them in "
            "the middle of each move (longest {:.0f} s); pictures show their true place and the "
            "sun of the instant, with sky, surroundings and temperatures of the stage",
            movement_of_objects.stage.size(), longest));
    }
    if (!weather.note.empty()) notes.push_back("weather: " + weather.note);
    if (std::string note = measured_albedo(scene, world, weather).note; !note.empty()) {
        notes.push_back(std::move(note));
    }
    std::vector<Mistake> warnings = dem.warnings;
    warnings.insert(warnings.end(), implausible.begin(), implausible.end());
    auto light = std::make_shared<const InstantLights>(scene, world, weather);
    scene.files = merged(scene.files, opened.files());
    return {std::make_shared<const SceneParts>(SceneParts{
                .scene = std::move(scene),
                .weather = std::move(weather),
                .sequences = std::move(pictures),
                .plan = std::move(plan),
                .plumes = std::move(plumes),
                .radiometers = std::move(radiometers),
                .notes = std::move(notes),
                .movement = std::move(movement_of_objects),
                .warnings = std::move(warnings),
                .light = std::move(light),
            }),
            std::make_shared<const ScenePlace>(ScenePlace{std::move(world), std::move(rays)})};
}

}  // namespace diurna
