// The default scene's day: real horizons, its own materials and weather.

#include <fmt/format.h>

#include "scenes/job.hpp"
#include "scenes/scene_file.hpp"
#include "terrain/parallel.hpp"
#include "thermal/solver.hpp"

using namespace diurna;

int main() {
    const Prepared prepared =
        prepare(read_scene(std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/scene.toml"));
    const SkyView view = sky_view(prepared.world.facets, prepared.rays,
                                  {.rays = prepared.scene.sky_rays, .seed = prepared.scene.seed});
    Progress progress(ProgressStyle::silent);
    const SolveResult result = solve_scene(prepared, view, progress);
    const SolveReport& r = result.report;
    fmt::print(stderr,
               "passes {} exchange {:.3f} W/m2 estimated {:.1e} K closure {:.1e} newton {:.2f} "
               "worst {} bisections {}; shortwave {:.2f} s exchange {:.2f} s steps {:.2f} s "
               "({:.2f} s cpu); {:.1f} "
               "to {:.1f} K\n",
               r.passes, r.exchange_change, r.estimated_error, r.worst_energy_closure,
               r.newton_iterations, r.worst_newton_iterations, r.bisections, r.shortwave_seconds,
               r.exchange_seconds, r.step_seconds, r.step_cpu_seconds, r.coldest, r.warmest);
    fmt::print("case,method,setting,facets,threads,wall_s,error,unit\n");
    fmt::print("jacksboro_day,modes,{} steps,{},{},{:.3f},{:.2e},K periodic\n", r.steps, r.facets,
               thread_count(), r.seconds, r.periodic_residual);
    return 0;
}
