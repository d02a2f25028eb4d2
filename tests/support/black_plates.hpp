#pragma once

#include <array>
#include <cmath>

#include "materials/base/units.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/hill_world.hpp"
#include "tests/support/plates_under_sky.hpp"
#include "thermal/solve/solver.hpp"
#include "thermal/weather/clear_sky.hpp"

namespace diurna::testing {

struct PlateKelvin {
    double solved, exact;
};

/// Black plates of all slopes on open ground or in a street, without air: they settle where σ T⁴ is
/// what arrives. Unsworth & Monteith (1975): ε(z) = ε + 0.09 (ln sec z − ½), summed over
/// directions; what is no open sky counts as the horizontal's, since nothing is exchanged.
inline std::array<PlateKelvin, tilt_deg.size()> black_plates(bool street) {
    const Plates plates(street);
    FacetViews views =
        facet_views(plates.facets, RayScene(plates.facets), {.rays = 8192, .others = false});
    views.others.row.assign(plates.facets.size() + 1, 0);
    const Material black = hill_world::ground("plate", 0.0, 1.0, ConstantFilm{0.0},
                                              {{0.01, 10.0, 1000.0, 1000.0}}, FixedFlux{0.0});
    const MaterialLibrary materials({black});
    Forcing forcing;
    forcing.air = {.temperature = 290.0, .pressure = 1e5, .vapour_pressure = 1000.0};
    forcing.shortwave_down = 0.0;
    const SunExposure sun;
    const SolveResult result =
        solve({.facets = plates.facets,
               .views = views,
               .sun = sun,
               .materials = materials,
               .weather = Weather{.instant = {Instant{}}, .sample = {forcing}},
               .site = {36.0, -84.0, 300.0},
               .elevation = 300.0},
              {.start = parse_instant("2026-06-21T00:00:00Z"), .exchange = false});
    std::array<PlateKelvin, tilt_deg.size()> kelvin{};
    for (std::size_t k = 0; k < tilt_deg.size(); ++k) {
        const double more = plates.sum(tilt_deg[k], [](const Eigen::Vector3d& way) {
            return 0.09 * (-std::log(way.z()) - 0.5);
        });
        const double flux = clear_longwave(forcing.air) + more * stefan_boltzmann * power4(290.0);
        kelvin[k] = {double{result.temperature.at(5)[plates.plate[k]]},
                     std::pow(flux / stefan_boltzmann, 0.25)};
    }
    return kelvin;
}

}  // namespace diurna::testing
