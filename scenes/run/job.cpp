#include "scenes/run/job.hpp"

#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "scenes/report/report.hpp"
#include "scenes/run/frames.hpp"
#include "scenes/run/manifest.hpp"
#include "scenes/world/air.hpp"
#include "terrain/raster/read_dem.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/reciprocity.hpp"
#include "terrain/visibility/relief_visibility.hpp"
#include "thermal/solve/shadow_edges.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

Observer placed(const ObserverInput& input, const Dem& dem, const World& world,
                const RayScene& rays, const Scene& scene) {
    const std::string where = fmt::format("{}: observer \"{}\"", scene.file.string(), input.name);
    Observer observer{.name = input.name,
                      .position = ground_point(dem, world.site, input.place, where) +
                                  Eigen::Vector3d(0.0, 0.0, input.height_above_ground),
                      .azimuth_deg = input.azimuth_deg,
                      .elevation_deg = input.elevation_deg,
                      .roll_deg = input.roll_deg,
                      .horizontal_fov_deg = input.horizontal_fov_deg,
                      .width = input.width,
                      .height = input.height,
                      .projection = input.projection,
                      .picture_width = input.picture_width,
                      .velocity = input.velocity,
                      .row_time = input.row_time,
                      .exposure = input.exposure};
    if (input.look_at) {
        observer = looking_at(observer, ground_point(dem, world.site, *input.look_at, where));
    }
    check_observer(observer, world.facets, rays);
    return observer;
}

ReliefVisibility light_of(const Prepared& prepared) {
    return {prepared.world.facets, prepared.rays, *prepared.world.relief,
            prepared.world.ground_facets};
}

}  // namespace

Prepared prepare(Scene scene) {
    std::vector<fs::path> tiles{scene.terrain.elevation};
    tiles.insert(tiles.end(), scene.terrain.tiles.begin(), scene.terrain.tiles.end());
    const Dem dem = read_dem(tiles, scene.terrain.reading);
    World world = build_world(scene, dem);
    RayScene rays(world.facets);
    Weather weather = scene_weather(scene, world);
    std::vector<Observer> observers;
    for (const ObserverInput& observer : scene.observers) {
        observers.push_back(placed(observer, dem, world, rays, scene));
    }
    check_table(scene, world, observers);
    std::vector<Plume> plumes;
    for (const PlumeInput& plume : scene.plumes) {
        const std::string where = fmt::format("{}: plume \"{}\"", scene.file.string(), plume.name);
        plumes.push_back(plume_at(plume, ground_point(dem, world.site, plume.place, where)));
    }
    std::vector<std::string> notes = dem.notes;
    for (std::string& note : lay_textures(scene, world)) notes.push_back(std::move(note));
    Plan plan = make_plan(scene, world);
    for (std::string& note : table_notes(scene)) notes.push_back(std::move(note));
    if (world.filled_facets > 0) {
        notes.push_back(fmt::format("{} of {} posts void and filled in: {} of {} ground facets",
                                    dem.voids, dem.height.size(), world.filled_facets,
                                    world.ground_facets));
    }
    return {std::move(scene),     std::move(world), std::move(rays),   std::move(weather),
            std::move(observers), std::move(plan),  std::move(plumes), std::move(notes)};
}

FacetViews scene_sky_view(const Prepared& prepared) {
    FacetViews view = light_of(prepared).facet_views({.rays = prepared.scene.sky_rays,
                                                      .first_object = prepared.world.ground_facets,
                                                      .object_rays = prepared.scene.object_sky_rays,
                                                      .seed = prepared.scene.seed});
    make_reciprocal(prepared.world.facets, view);
    const TextureLevels& texture_levels = prepared.world.texture_levels;
    return texture_levels.empty() ? view : for_all_levels(texture_levels, view);
}

/// Temperatures are kept at every frame and, for the curves of a day and where they cross, at least
/// each half hour: the longest whole number of steps that does both [s].
double kept_every(const TimeInput& time) {
    const auto steps = static_cast<int>(std::lround(time.frame_every / time.step));
    int kept = steps;
    while (kept > 1 && (steps % kept != 0 || kept * time.step > 1800.0)) --kept;
    return kept * time.step;
}

SolveOptions scene_solve_options(const Scene& scene) {
    SolveOptions options;
    options.start = scene.time.start;
    options.duration = scene.time.duration;
    options.step = scene.time.step;
    options.keep_every = kept_every(scene.time);
    options.periodic = scene.time.duration == 86400.0;
    return options;
}

SunExposure scene_sun_exposure(const Prepared& prepared, Progress& progress) {
    const Scene& scene = prepared.scene;
    const std::size_t facets = prepared.world.facets.size();
    const ReliefVisibility light = light_of(prepared);
    SunExposure exposure{.instant = step_instants(scene_solve_options(scene)), .fraction = {}};
    exposure.fraction.assign(exposure.instant.size() * facets, 0.0f);
    for (std::size_t i = 0; i < exposure.instant.size(); ++i) {
        const SunPosition sun = sun_position(prepared.world.site, exposure.instant[i]);
        light.sun_fraction(sun_direction(sun),
                           std::span(exposure.fraction).subspan(i * facets, facets),
                           {.samples = scene.sun_samples, .seed = scene.seed});
        progress.done(static_cast<double>(i + 1) / static_cast<double>(exposure.instant.size()));
    }
    // When within a step the sun comes and goes: by rays, which answer for single facets.
    find_edges(exposure,
               [&](Instant when, std::span<const std::uint8_t> chosen, std::span<float> fraction) {
                   sun_fraction(prepared.world.facets, prepared.rays,
                                sun_direction(sun_position(prepared.world.site, when)), chosen,
                                fraction, {.samples = scene.sun_samples, .seed = scene.seed});
               },
               {.tolerance = 20.0});
    const TextureLevels& texture_levels = prepared.world.texture_levels;
    if (texture_levels.empty()) return exposure;
    exposure.fraction = for_all_levels(texture_levels, exposure.fraction);
    std::vector<ShadowEdge> edges;
    for (const ShadowEdge& edge : exposure.edge) {
        edges.push_back(edge);
        const TextureLevels::OfFacet& of_facet = texture_levels.of_facet[edge.facet];
        for (std::uint32_t copy = 0; copy + 1 < of_facet.levels; ++copy) {
            edges.push_back({edge.step, of_facet.first_copy + copy, edge.share});
        }
    }
    exposure.edge = std::move(edges);
    return exposure;
}

SolveResult solve_scene(const Prepared& prepared, const FacetViews& views, Progress& progress) {
    progress.stage("shadows");
    const SunExposure exposure = scene_sun_exposure(prepared, progress);
    progress.stage("heat balance");
    SolveOptions options = scene_solve_options(prepared.scene);
    options.progress = [&](double share) { progress.done(share); };
    return solve({.facets = prepared.world.surfaces(),
                  .views = views,
                  .sun = exposure,
                  .materials = prepared.scene.materials,
                  .weather = prepared.weather,
                  .site = prepared.world.site,
                  .elevation = prepared.world.sea_level_height},
                 options);
}

JobReport run_job(Scene scene, const JobOptions& options) {
    Progress progress(options.progress);
    progress.stage("terrain");
    const Prepared prepared = prepare(std::move(scene));
    const Scene& checked = prepared.scene;

    // Nothing has been written so far; from here on only whole files are.
    fs::create_directories(options.out / "frames");
    const std::string key = job_key(checked, options.settings);
    const bool keep = options.resume && manifest_key(options.out) == key;
    if (!keep) {
        fs::remove(options.out / "temperatures.nc");
        for (const std::string& file : frame_files(prepared)) fs::remove(options.out / file);
    }
    write_manifest(options.out, checked, options.settings, key);

    progress.stage("sky view");
    const FacetViews view = scene_sky_view(prepared);

    JobReport report;
    report.plan = prepared.plan;
    report.ground_check = prepared.world.ground_check;
    report.posts = prepared.world.posts;
    const fs::path temperatures = options.out / "temperatures.nc";
    TemperatureField field;
    if (keep && fs::exists(temperatures)) {
        field = load_temperature_field(temperatures);
    } else {
        SolveResult result = solve_scene(prepared, view, progress);
        progress.stage("write temperatures");
        save_temperature_field(temperatures, result.temperature, prepared.world.surfaces(),
                               prepared.world.site);
        field = std::move(result.temperature);
        report.solve = result.report;
        report.solved = true;
    }
    report.notes = prepared.notes;
    if (!prepared.weather.note.empty()) report.notes.push_back(prepared.weather.note);

    report.files = {"temperatures.nc"};
    std::vector<std::string> errors;
    report.frames_rendered = render_frames(prepared, view, field, options.out, progress, &errors);
    for (const std::string& line : errors) {
        report.notes.push_back("tables against the direct sum, worst frame: " + line);
    }
    for (std::string& file : frame_files(prepared)) report.files.push_back(std::move(file));

    progress.stage("report");
    annotate_frames(prepared, options.out);
    report.files.push_back("annotations.json");
    const std::vector<DiurnalCurve> curves =
        diurnal_curves(field, prepared.world.surfaces(), checked.materials);
    report.stages = progress.stages();
    write_report(options.out, prepared, report, field.instant, curves);
    report.files.push_back("report.html");
    progress.finish();
    report.stages = progress.stages();
    write_manifest(options.out, checked, options.settings, key, report.files, report.stages);
    return report;
}

}  // namespace diurna
