#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/commands/raster_commands.hpp"
#include "scenes/input/scene_file.hpp"
#include "scenes/run/frames.hpp"
#include "scenes/run/job.hpp"

namespace {

using namespace diurna;

enum ExitCode { done = 0, failed = 1, bad_input = 2 };

/// Options that verbs working on a scene share.
struct SceneArguments {
    std::filesystem::path scene;
    std::vector<std::string> settings;
    JobOptions job;
    std::string progress;
    int threads = 0;

    Scene read() const {
        set_thread_count(threads);
        return read_scene(scene, settings);
    }
    ProgressStyle style() const {
        if (progress == "json") return ProgressStyle::json;
        if (progress == "none") return ProgressStyle::silent;
        return default_progress_style();
    }
};

void add_scene_options(CLI::App& verb, SceneArguments& a) {
    verb.add_option("SCENE", a.scene, "scene file (TOML)")->required();
    verb.add_option("--set", a.settings, "key.path=value in place of what the file says");
    verb.add_option("--threads", a.threads, "worker threads; 0: one per core")
        ->check(CLI::Range(0, 1024));
    verb.add_option("--progress", a.progress, "json, none or auto")
        ->check(CLI::IsMember({"json", "none", "auto"}));
}

void check_verb(const SceneArguments& a) {
    const Prepared prepared = prepare(a.read());
    fmt::print("{}: fine, {} facets, {} observers\n", a.scene.string(),
               prepared.world.surfaces().size(), prepared.observers.size());
    for (const std::string& note : prepared.notes) fmt::print(stderr, "note: {}\n", note);
}

void run_verb(SceneArguments& a) {
    a.job.settings = a.settings;
    a.job.progress = a.style();
    const JobReport report = run_job(a.read(), a.job);
    double seconds = 0.0;
    for (const auto& stage : report.stages) seconds += stage.seconds;
    fmt::print("{} facets, {} frames rendered, {} files, {:.1f} s: {}\n", report.plan.facets,
               report.frames_rendered, report.files.size(), seconds,
               (a.job.out / "report.html").string());
}

void solve_verb(const SceneArguments& a, const std::filesystem::path& out) {
    const Prepared prepared = prepare(a.read());
    Progress progress(a.style());
    progress.stage("sky view");
    const FacetViews view = scene_sky_view(prepared);
    const SolveResult result = solve_scene(prepared, view, progress);
    save_temperature_field(out, result.temperature, prepared.world.surfaces(), prepared.world.site);
}

void render_verb(const SceneArguments& a, const std::filesystem::path& temperatures,
                 const std::filesystem::path& out) {
    const Prepared prepared = prepare(a.read());
    const TemperatureField field = load_temperature_field(temperatures);
    if (field.facets != prepared.world.surfaces().size()) {
        throw InputError(temperatures.string(),
                         fmt::format("found temperatures of {} facets, expected {} as in the scene",
                                     field.facets, prepared.world.surfaces().size()));
    }
    std::filesystem::create_directories(out / "frames");
    Progress progress(a.style());
    progress.stage("sky view");
    const FacetViews view = scene_sky_view(prepared);
    render_frames(prepared, view, field, out, progress);
}

/// "diurna rnu ..." gets "did you mean 'run'?"; CLI11 would say only that RUN is required.
void check_first_word(const CLI::App& app, int argc, char** argv) {
    if (argc < 2 || argv[1][0] == '-') return;
    std::vector<std::string> verbs;
    for (const CLI::App* verb : app.get_subcommands({})) verbs.push_back(verb->get_name());
    if (std::find(verbs.begin(), verbs.end(), argv[1]) != verbs.end()) return;
    const std::string hint = did_you_mean(argv[1], verbs);
    throw InputError("diurna", fmt::format("no verb '{}'", argv[1]),
                     hint.empty() ? fmt::format("{}", fmt::join(verbs, ", ")) : hint);
}

void run_program(int argc, char** argv) {
    CLI::App app("thermal and diurnal terrain scenes, rendered for calibrated instruments",
                 "diurna");
    app.set_version_flag("--version", "diurna " DIURNA_VERSION);
    app.require_subcommand(1);
    SceneArguments scene;
    std::filesystem::path out_file, temperatures, column_file;

    CLI::App* verb = app.add_subcommand("check", "every mistake of a scene file at once");
    add_scene_options(*verb, scene);
    verb->callback([&] { check_verb(scene); });

    verb = app.add_subcommand("plan", "what would be computed and what is skipped");
    add_scene_options(*verb, scene);
    verb->callback([&] { fmt::print("{}", describe(prepare(scene.read()).plan)); });

    verb = app.add_subcommand("run", "the whole job: temperatures, frames, report");
    add_scene_options(*verb, scene);
    verb->add_option("--out", scene.job.out, "folder for the results (default: out)");
    verb->add_flag("--resume", scene.job.resume,
                   "keep what an earlier run of the same inputs left");
    verb->callback([&] { run_verb(scene); });

    verb = app.add_subcommand("solve", "temperatures alone");
    add_scene_options(*verb, scene);
    verb->add_option("--out", out_file, "netCDF file")->required();
    verb->callback([&] { solve_verb(scene, out_file); });

    verb = app.add_subcommand("render", "frames from given temperatures");
    add_scene_options(*verb, scene);
    verb->add_option("--temperatures", temperatures, "netCDF file of `solve`")->required();
    verb->add_option("--out", scene.job.out, "folder for the results (default: out)");
    verb->callback([&] { render_verb(scene, temperatures, scene.job.out); });

    verb = app.add_subcommand("column", "one facet driven by a weather file");
    verb->add_option("COLUMN", column_file, "column file (TOML)")->required();
    verb->add_option("--out", out_file, "CSV file; without it the result goes to stdout");
    verb->callback([&] { column_command(column_file, out_file); });

    PathArguments path;
    verb = app.add_subcommand("path", "transmittance and radiance of one path through the air");
    verb->add_option("--profile", path.profile,
                     "TROP MLS MLW SAS SAW US76, or a radiosonde's .csv file");
    verb->add_option("--aerosol", path.aerosol, "none, rural, maritime, urban, ...");
    verb->add_option("--visibility-km", path.visibility_km);
    verb->add_option("--co2-ppm", path.co2_ppm);
    verb->add_option("--ground-km", path.ground_km, "where the haze begins");
    verb->add_option("--rain-mm-h", path.rain_mm_h);
    verb->add_option("--height-km", path.height_km, "start of the path above the sea");
    verb->add_option("--zenith-deg", path.zenith_deg, "at the start of the path");
    verb->add_option("--range-km", path.range_km);
    verb->add_option("--to-height-km", path.to_height_km);
    verb->add_flag("--to-ground", path.to_ground);
    verb->add_flag("--to-space", path.to_space);
    verb->add_option("--sun-zenith-deg", path.sun_zenith_deg, "adds scattered sunlight");
    verb->add_option("--azimuth-from-sun-deg", path.azimuth_from_sun_deg, "of the path");
    verb->add_option("--ground-albedo", path.ground_albedo);
    verb->add_option("--band", path.bands, "FROM:TO in micrometres; may be given again")
        ->required();
    verb->add_option("--csv", path.csv, "file for the whole spectrum");
    verb->add_option("--modtran", path.modtran,
                     "MODTRAN 5 to run in place of the embedded model (absolute path)");
    verb->callback([&] { path_command(path); });

    SunArguments sun;
    verb = app.add_subcommand("sun", "azimuth, elevation and distance of the sun");
    verb->add_option("--latitude-deg", sun.latitude_deg)->required();
    verb->add_option("--longitude-deg", sun.longitude_deg)->required();
    verb->add_option("--height-m", sun.height_m);
    verb->add_option("--time", sun.time, "ISO 8601 with offset")->required();
    verb->add_option("--pressure-hPa", sun.pressure_hPa, "adds refraction");
    verb->add_option("--temperature-C", sun.temperature_C);
    verb->callback([&] { sun_command(sun); });

    MeshArguments mesh;
    verb = app.add_subcommand("mesh", "triangulate an elevation raster to a vertical tolerance");
    verb->add_option("DEM", mesh.dem, "any raster of the drivers GDAL is allowed")->required();
    verb->add_option("--tolerance-m", mesh.tolerance_m)->required()->check(CLI::NonNegativeNumber);
    verb->add_option("--frame", mesh.frame)->check(CLI::IsMember({"enu", "grid"}));
    verb->add_option("--out", mesh.out, "PLY file");
    verb->callback([&] { mesh_command(mesh); });

    VisibilityArguments visibility;
    verb = app.add_subcommand("visibility", "sky view and shadows of every post of a raster");
    verb->add_option("DEM", visibility.dem, "elevation raster, or several tiles of one lattice")
        ->required();
    verb->add_option("--azimuths", visibility.azimuths)->check(CLI::Range(4, 4096));
    verb->add_option("--sun-azimuth-deg", visibility.sun_azimuth_deg, "clockwise from north");
    verb->add_option("--sun-elevation-deg", visibility.sun_elevation_deg)
        ->check(CLI::Range(-90.0, 90.0));
    verb->add_option("--out", visibility.out, "GeoTIFF in the raster's place");
    verb->callback([&] { visibility_command(visibility); });

    verb = app.add_subcommand("doctor", "versions, processor, threads, where data are found");
    verb->callback([&] { doctor_command(); });

    check_first_word(app, argc, argv);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
            app.exit(error);  // --help and --version
            return;
        }
        throw InputError("diurna", error.what(), "diurna --help");
    }
}

}  // namespace

int main(int argc, char** argv) {
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) {
        std::fputs("diurna: this processor has no AVX2 and FMA, which the program needs\n", stderr);
        return failed;
    }
    try {
        run_program(argc, argv);
        return done;
    } catch (const InputError& error) {
        for (const Mistake& mistake : error.mistakes()) fmt::print(stderr, "{}\n", mistake.line());
        return bad_input;
    } catch (const std::exception& error) {
        fmt::print(stderr, "diurna: {}\n", error.what());
        return failed;
    }
}
