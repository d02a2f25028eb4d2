// A target's day: a truck of the program's own that idles on a plain, found periodic, at steps of
// five minutes, with sun, sky and neighbours of every facet. Time is of the processor on one
// thread, all of solve(); on all of them of the clock, to be read where nothing else runs. Errors
// are of all facets at every fifth minute against steps of 50 s and neighbours' heat that has
// settled a hundred times as far.

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <ctime>

#include "materials/base/files.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/scene_sky_view.hpp"
#include "scenes/job/run/sun_exposure.hpp"
#include "scenes/job/world/stepping.hpp"
#include "scenes/job/world/targets.hpp"
#include "tests/support/sheet_scene.hpp"
#include "thermal/solve/solver.hpp"

using namespace diurna;
namespace over_plain = diurna::testing::over_plain;

namespace {

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

Prepared truck_on_plain(const std::string& detail) {
    const ScratchFolder folder("network_bench");
    over_plain::write_scene(folder.path, {.mesh = over_plain::level_square(2),
                                          .beam = 700.0,
                                          .longwave = 330.0,
                                          .albedo = 0.3,
                                          .black = 0.95,
                                          .ground_edge = 2.0});
    const std::filesystem::path file = folder.path / "scene.toml";
    std::string text = read_text(file);
    const auto begin = text.find("[[object]]"), end = text.find("[material.");
    text.replace(begin, end - begin,
                 fmt::format("[[object]]\nname = \"it\"\nmodel = \"truck\"\ndetail = \"{}\"\n"
                             "place_m = [0, 0]\nrunning = [\"00:00-24:00\"]\n",
                             detail));
    const auto put = [&](const std::string& old, const std::string& next) {
        text.replace(text.find(old), old.size(), next);
    };
    put("object_sky_rays = 1024", "object_sky_rays = 256");
    put("sky_rays = 1024", "sky_rays = 64");
    const std::string start = "start = 2026-03-20T00:00:00Z\n";
    text.insert(text.find(start) + start.size(), "duration_h = 24\n");
    write_text(file, text);
    return prepare(read_scene(file));
}

void print_rows(const std::string& detail) {
    const Prepared prepared = truck_on_plain(detail);
    const FacetViews view = scene_sky_view(prepared);
    const SolveOptions five_minutes{.start = prepared.scene.time.start,
                                    .duration = 86400.0,
                                    .step = 300.0,
                                    .keep_every = 300.0};
    const SunExposure sun = scene_sun_exposure(prepared, step_instants(five_minutes));
    const std::vector<NetworkObject> network = targets(prepared.world, prepared.scene);
    const auto run = [&](const SolveOptions& options) {
        return solve({.facets = prepared.world.surfaces(),
                      .views = view,
                      .sun = sun,
                      .materials = prepared.scene.materials,
                      .weather = prepared.weather,
                      .site = prepared.world.site,
                      .elevation = prepared.world.sea_level_height,
                      .network = network},
                     options);
    };
    SolveOptions finer = five_minutes;
    finer.refinement = 6;
    finer.settled = 1e-4;
    finer.max_passes = 30;
    set_thread_count(0);
    const SolveResult exact = run(finer);
    set_thread_count(1);
    const double since = cpu_seconds();
    const SolveResult day = run(five_minutes);
    const double seconds = cpu_seconds() - since;
    set_thread_count(0);
    const auto begun = std::chrono::steady_clock::now();
    const SolveResult side_by_side = run(five_minutes);
    const double on_clock =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    double apart = 0.0;
    double worst = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < exact.temperature.kelvin.size(); ++k) {
        const double error = double(day.temperature.kelvin[k]) - exact.temperature.kelvin[k];
        apart = std::max(apart, std::abs(double(day.temperature.kelvin[k]) -
                                         side_by_side.temperature.kelvin[k]));
        worst = std::max(worst, std::abs(error));
        sum += error * error;
    }
    const SolveReport& report = day.report;
    const auto row = [&](double error, const char* unit, int threads = 1) {
        fmt::print("target_day,network,idling truck {} detail passes {},{},{},{:.2f},{:.2g},{}\n",
                   detail, report.passes, report.target_facets, threads,
                   threads == 1 ? seconds : on_clock, error, unit);
    };
    row(std::sqrt(sum / double(exact.temperature.kelvin.size())), "K rms");
    row(worst, "K worst");
    row(report.estimated_error, report.converged ? "K estimated" : "K estimated not converged");
    row(report.worst_energy_closure, "of heat unaccounted");
    row(apart, "K from one thread's; seconds on the clock", thread_count());
    std::fflush(stdout);
}

}  // namespace

int main() {
    fmt::print("case,method,setting,facets,threads,seconds,error,unit\n");
    for (const char* detail : {"low", "medium", "high"}) print_rows(detail);
    return 0;
}
