// The heat balance of the whole default scene, all that a job does of it once sky view and shadows
// are known: a periodic day from its first guess to 1e-4 K, shadows' edges at their instants, real
// horizons, two trucks of thin sheet on an apron, with and without exchange between facets. Time is
// of the processor, all of solve(): sunlight, first guess, passes, exchange. Errors are of every
// facet at every step's instant against steps twelve times as short, modes four times as fine and a
// period closed to 1e-6 K.

#include "scenes/world/stepping.hpp"
#include "thermal/solve/solver.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <ctime>

#include "materials/base/parallel.hpp"
#include "scenes/input/scene_file.hpp"
#include "scenes/run/heat.hpp"

using namespace diurna;

namespace {

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// [MB] the process's largest so far
double peak_memory() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return double(usage.ru_maxrss) / 1024.0;
}

struct Row {
    std::string setting;
    SolveResult result;
    double cpu = 0.0, memory = 0.0;
};

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
        return Row{setting, std::move(result), cpu_seconds() - since, peak_memory() - before};
    };
    set_thread_count(1);
    fmt::print(
        "case,method,setting,facets,passes,periodic_K,estimated_K,cpu_s,facet_days_per_s,"
        "exchange_wall_s,rms_K,max_K,peak_MB\n");
    for (const bool exchange : {true, false}) {
        SolveOptions o = plain;
        o.exchange = exchange;
        std::vector<Row> rows;
        const std::string with = exchange ? "with exchange" : "without exchange";
        rows.push_back(run(o, with));
        o.mode_error = 0.03;
        o.tolerance = 1e-2;
        rows.push_back(run(o, with + " modes 0.03 tolerance 1e-2"));
        o = plain;
        o.exchange = exchange;
        o.refinement = 2;
        rows.push_back(run(o, with + " half steps"));
        set_thread_count(0);
        o.refinement = 12;
        o.mode_error = 0.001;
        o.tolerance = 1e-6;
        o.max_passes = 20;
        const TemperatureField exact = run(o, "").result.temperature;
        set_thread_count(1);
        for (const Row& row : rows) {
            const SolveReport& r = row.result.report;
            double worst = 0.0, sum = 0.0;
            for (std::size_t k = 0; k < exact.kelvin.size(); ++k) {
                const double error = double(row.result.temperature.kelvin[k]) - exact.kelvin[k];
                worst = std::max(worst, std::abs(error));
                sum += error * error;
            }
            fmt::print(
                "scene_day,modes,{},{},{},{:.1e},{:.1e},{:.2f},{:.0f},{:.2f},{:.4f},{:.4f},{:.0f}"
                "\n",
                row.setting, r.facets, r.passes, r.periodic_residual, r.estimated_error, row.cpu,
                double(r.facets) / row.cpu, r.exchange_seconds,
                std::sqrt(sum / double(exact.kelvin.size())), worst, row.memory);
        }
        std::fflush(stdout);
    }
    return 0;
}
