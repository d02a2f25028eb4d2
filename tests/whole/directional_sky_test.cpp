#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/units.hpp"
#include "terrain/place/site.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/hill_world.hpp"
#include "tests/support/plates_under_sky.hpp"
#include "thermal/solve/solver.hpp"
#include "thermal/weather/clear_sky.hpp"

// Plates of all slopes on open ground and in a street, against sums over directions one by one.

using namespace diurna;

using testing::Plates;
using testing::tilt_deg;

TEST_CASE("black plates of all slopes are as warm as the sky they see", "[whole][sky][longwave]") {
    // Unsworth & Monteith (1975): ε(z) = ε + 0.09 (ln sec z − ½); what is no open sky counts as the
    // horizontal's here, since nothing is exchanged. Without air they settle where σ T⁴ arrives.
    const Plates plates(GENERATE(false, true));
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
    CHECK(result.report.converged);
    for (std::size_t k = 0; k < tilt_deg.size(); ++k) {
        const double more = plates.sum(tilt_deg[k], [](const Eigen::Vector3d& way) {
            return 0.09 * (-std::log(way.z()) - 0.5);
        });
        const double flux = clear_longwave(forcing.air) + more * stefan_boltzmann * power4(290.0);
        CAPTURE(plates.street, tilt_deg[k], more);
        CHECK(double{result.temperature.at(5)[plates.plate[k]]} ==
              Approx(std::pow(flux / stefan_boltzmann, 0.25)).margin(0.05));
    }
}
