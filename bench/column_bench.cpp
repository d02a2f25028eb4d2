// Time against error of the heat balance, every method and setting, on a sample of the default
// scene's facets under its own horizons and weather: a periodic day, its start included. Time is of
// the processor, on one thread; exchange between facets is left out. The reference is layered, in
// steps of 25 s or less on a grid four times as fine.

#include <fmt/format.h>

#include <cmath>

#include "scenes/job.hpp"
#include "scenes/scene_file.hpp"
#include "terrain/parallel.hpp"
#include "terrain/visibility.hpp"
#include "thermal/solver.hpp"

using namespace diurna;

int main() {
    const Prepared prepared =
        prepare(read_scene(std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/scene.toml"));
    const FacetSet& all = prepared.world.facets;
    constexpr std::size_t every = 100;
    FacetSet facets;
    std::vector<std::uint8_t> chosen(all.size(), 0);
    for (std::size_t f = 0; f < all.size(); f += every) {
        chosen[f] = 1;
        facets.centroid.push_back(all.centroid[f]);
        facets.normal.push_back(all.normal[f]);
        facets.area.push_back(all.area[f]);
        facets.material.push_back(all.material[f]);
    }
    const SkyView whole = sky_view(all, prepared.rays, {.rays = 16});
    SkyView view;
    for (std::size_t f = 0; f < all.size(); f += every) {
        view.sky_view.push_back(whole.sky_view[f]);
        view.below.push_back(whole.below[f]);
    }
    view.exchange.row.assign(facets.size() + 1, 0);
    SolveOptions options;
    options.start = prepared.scene.time.start;
    options.keep_every = options.step;
    options.exchange = false;
    SunExposure sun{.instant = step_instants(options), .fraction = {}};
    std::vector<float> fraction(all.size(), 0.0f);
    for (const Instant when : sun.instant) {
        sun_fraction(all, prepared.rays, sun_direction(sun_position(prepared.world.site, when)),
                     chosen, fraction);
        for (std::size_t f = 0; f < all.size(); f += every) sun.fraction.push_back(fraction[f]);
    }
    set_thread_count(1);
    const auto run = [&](const SolveOptions& o) {
        return solve({.facets = facets,
                      .sky_view = view,
                      .sun = sun,
                      .materials = prepared.scene.materials,
                      .weather = prepared.weather,
                      .site = prepared.world.site,
                      .elevation = prepared.world.sea_level_height},
                     o);
    };
    SolveOptions exact = options;
    exact.method = Method::layered;
    exact.refinement = 24;
    exact.tolerance = 1e-5;
    exact.max_passes = 20;
    exact.grid = {.first = 0.0125, .growth = 0.08};
    const SolveResult reference = run(exact);
    fmt::print("case,method,setting,facets,passes,cpu_s,facet_days_per_s,rms_K,max_K\n");
    for (const Method method : {Method::layered, Method::modes}) {
        for (const int refinement : {1, 2, 4}) {
            for (const double mode_error : {0.03, 0.01, 0.003}) {
                for (const double tolerance : {1e-2, 1e-3, 1e-4}) {
                    if (method == Method::layered && mode_error != 0.01) continue;
                    SolveOptions o = options;
                    o.method = method;
                    o.refinement = refinement;
                    o.mode_error = mode_error;
                    o.tolerance = tolerance;
                    const SolveResult result = run(o);
                    double worst = 0.0, sum = 0.0;
                    const std::vector<float>&a = result.temperature.kelvin,
                          &b = reference.temperature.kelvin;
                    for (std::size_t i = 0; i < a.size(); ++i) {
                        const double error = double(a[i]) - b[i];
                        worst = std::max(worst, std::abs(error));
                        sum += error * error;
                    }
                    const SolveReport& r = result.report;
                    fmt::print(
                        "column_day,{},steps/{} modes {} tolerance {:.0e},{},{},{:.4f},"
                        "{:.0f},{:.4f},{:.4f}\n",
                        method == Method::modes ? "modes" : "layered", refinement, mode_error,
                        tolerance, facets.size(), r.passes, r.step_cpu_seconds,
                        double(facets.size()) / r.step_cpu_seconds,
                        std::sqrt(sum / double(a.size())), worst);
                }
            }
        }
    }
    return 0;
}
