// A day on rolling ground of six library materials: what the heat balance of a scene costs, and how
// far it is from a solve with steps twelve times as short.

#include "thermal/solver.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "../tests/hills.hpp"
#include "terrain/parallel.hpp"

using namespace diurna;

int main(int argc, char** argv) {
    const int cells = argc > 1 ? std::atoi(argv[1]) : 280;
    const Site site{.latitude_deg = 36.5, .longitude_deg = -84.2, .height = 400.0};
    const Instant start = parse_instant("2026-07-15T04:00:00Z");
    const MaterialLibrary materials = default_material_library();
    std::vector<MaterialId> used;
    for (const char* name : {"grass", "forest", "bare_soil", "rock", "asphalt", "concrete"}) {
        used.push_back(materials.find(name));
    }
    const FacetSet facets = hills(cells, used);
    const RayScene rays(facets);
    const SkyView view = sky_view(facets, rays);
    Weather weather;
    for (int h = 0; h <= 24; ++h) {
        const double wave = std::cos(2.0 * M_PI * (h - 15) / 24.0);
        Forcing forcing;
        forcing.air = {
            .temperature = 297.0 + 6.0 * wave, .pressure = 97000.0, .vapour_pressure = 1500.0};
        forcing.wind_speed = 2.5 + 1.5 * wave;
        weather.instant.push_back(later(start, 3600.0 * h));
        weather.sample.push_back(forcing);
    }
    const SolveOptions options{.start = start};
    const SunExposure sun = shadows(facets, rays, site, options);
    fmt::print(stderr, "{} facets, {} exchange entries\n", facets.size(),
               view.exchange.facet.size());
    const auto run = [&](int refinement) {
        SolveOptions o = options;
        o.keep_every = o.step;
        o.refinement = refinement;
        return solve({.facets = facets,
                      .sky_view = view,
                      .sun = sun,
                      .materials = materials,
                      .weather = weather,
                      .site = site,
                      .elevation = 400.0},
                     o);
    };
    fmt::print("case,method,setting,facets,threads,wall_s,error,unit\n");
    std::vector<SolveResult> results;
    for (const int refinement : {1, 1, 2, 12}) {
        set_thread_count(results.empty() ? 1 : 0);
        results.push_back(run(refinement));
        const SolveReport& r = results.back().report;
        fmt::print(stderr,
                   "passes {} exchange {:.3f} W/m2 estimated {:.1e} K closure {:.1e} newton {:.2f} "
                   "worst {} bisections {}; shortwave {:.2f} s exchange {:.2f} s steps {:.2f} s\n",
                   r.passes, r.exchange_change, r.estimated_error, r.worst_energy_closure,
                   r.newton_iterations, r.worst_newton_iterations, r.bisections,
                   r.shortwave_seconds, r.exchange_seconds, r.step_seconds);
        if (cells > 120 && results.size() == 2) break;
    }
    const std::vector<float>& exact = results.back().temperature.kelvin;
    for (std::size_t i = 0; i < results.size(); ++i) {
        double worst = 0.0, sum = 0.0;
        for (std::size_t k = 0; k < exact.size(); ++k) {
            const double error = double(results[i].temperature.kelvin[k]) - exact[k];
            worst = std::max(worst, std::abs(error));
            sum += error * error;
        }
        const SolveReport& r = results[i].report;
        const char* setting[]{"whole steps", "whole steps", "half steps", "steps of 50 s"};
        fmt::print("solver_day,modes,{},{},{},{:.3f},{:.2e},K periodic\n", setting[i],
                   facets.size(), i == 0 ? 1 : thread_count(), r.seconds, r.periodic_residual);
        fmt::print("solver_day,modes,{},{},{},{:.3f},{:.4f},K rms\n", setting[i], facets.size(),
                   i == 0 ? 1 : thread_count(), r.seconds, std::sqrt(sum / double(exact.size())));
        fmt::print("solver_day,modes,{},{},{},{:.3f},{:.4f},K max\n", setting[i], facets.size(),
                   i == 0 ? 1 : thread_count(), r.seconds, worst);
    }
    return 0;
}
