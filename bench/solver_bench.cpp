// The heat balance of the whole default scene, all that a job does of it once sky view and shadows
// are known: a periodic day from its first guess to 1e-4 K, shadows' edges at their instants, real
// horizons, two trucks of thin sheet on an apron, with and without exchange between facets, and in
// modes and plates alone, without the facets that are points because of dew. `quick` is as a run
// with tolerance_K solves (thermal/solve/solve_input.hpp). Time is of the processor, all of
// solve(): sunlight, first guess, passes, exchange. Errors are of every
// facet at every step's instant against steps twelve times as short, modes four times as fine and a
// period closed to 1e-6 K.

#include "scenes/job/world/stepping.hpp"
#include "thermal/solve/solver.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <ctime>

#include "materials/base/parallel.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/scene_sky_view.hpp"
#include "scenes/job/run/sun_exposure.hpp"

using namespace diurna;

namespace {

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// [MB] the process's largest so far
double peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024.0;
}

struct Run {
    std::string setting;
    SolveResult result;
    double cpu = 0.0, memory = 0.0;
};

/// What a run took, beside how far it is from `exact`, whether it has closed, and its memory.
void print_run(const Run& run, const TemperatureField& exact) {
    const SolveReport& r = run.result.report;
    double worst = 0.0, sum = 0.0;
    for (std::size_t k = 0; k < exact.kelvin.size(); ++k) {
        const double error = double(run.result.temperature.kelvin[k]) - exact.kelvin[k];
        worst = std::max(worst, std::abs(error));
        sum += error * error;
    }
    const auto row = [&](const char* method, double seconds, double error, const char* unit) {
        fmt::print("scene_day,{},{} passes {},{},1,{:.2f},{:.3g},{}\n", method, run.setting,
                   r.passes, r.facets, seconds, error, unit);
    };
    row("modes", run.cpu, std::sqrt(sum / double(exact.kelvin.size())), "K rms");
    row("modes", run.cpu, worst, "K worst");
    row("modes", run.cpu, double(r.facets) / run.cpu, "facet-days/s");
    row("modes", run.cpu, r.periodic_residual, "K period left open");
    row("modes", run.cpu, r.estimated_error, "K estimated");
    row("modes", run.cpu, run.memory, "MB");
    row("exchange_of_it", r.exchange_seconds, r.exchange_change, "W m-2 last change");
    std::fflush(stdout);
}

}  // namespace

int main() {
    const Prepared prepared =
        prepare(read_scene(std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/scene.toml"));
    const FacetViews view = scene_sky_view(prepared);
    const SunExposure sun = scene_sun_exposure(prepared, scene_steps(prepared.scene));
    const double before = peak_memory();
    SolveOptions plain{.start = prepared.scene.time.start,
                       .duration = prepared.scene.time.duration,
                       .step = prepared.scene.time.step};
    plain.keep_every = plain.step;
    const auto run = [&](const SolveOptions& options, const std::string& setting) {
        const double since = cpu_seconds();
        SolveResult result = solve({.facets = prepared.world.surfaces(),
                                    .views = view,
                                    .sun = sun,
                                    .materials = prepared.scene.materials,
                                    .weather = prepared.weather,
                                    .site = prepared.world.site,
                                    .elevation = prepared.world.sea_level_height},
                                   options);
        return Run{setting, std::move(result), cpu_seconds() - since, peak_memory() - before};
    };
    set_thread_count(1);
    fmt::print("case,method,setting,facets,threads,cpu_s,error,unit\n");
    SolveOptions with = plain, without = plain;
    without.exchange = false;
    SolveOptions alone = without;
    alone.least_dew = 1e9;
    for (const auto& [setting, given] : {std::pair{std::string("with exchange"), with},
                                         {std::string("without exchange"), without},
                                         {std::string("without exchange and points"), alone}}) {
        SolveOptions o = given;
        std::vector<Run> runs;
        runs.push_back(run(o, setting));
        runs.push_back(run(quick(o, 0.1), setting + " quick"));
        o.refinement = 2;
        runs.push_back(run(o, setting + " half steps"));
        set_thread_count(0);
        o.refinement = 12;
        o.mode_error = 0.001;
        o.tolerance = 1e-6;
        o.max_passes = 20;
        const TemperatureField exact = run(o, "").result.temperature;
        set_thread_count(1);
        for (const Run& each : runs) print_run(each, exact);
    }
    return 0;
}
