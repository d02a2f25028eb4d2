#include "thermal/column/nonlinear_column.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/units.hpp"
#include "tests/support/shared_data.hpp"
#include "tests/support/thermal_cases.hpp"
#include "thermal/point/point_job.hpp"
#include "thermal/point/run_column.hpp"

using namespace diurna;

namespace {

const Instant start_instant = parse_instant("2020-06-01T00:00:00Z");

/// A facet under constant air and sun, started uniform.
PointJob constant_job(std::vector<Layer> layers, double absorbed, double emissivity, double film,
                      double air, double initial, double span, double step) {
    PointJob job;
    job.surface.albedo = 0.0;
    job.surface.emissivity = emissivity;
    job.surface.convection = ConstantFilm{film};
    job.surface.layers = std::move(layers);
    job.start = start_instant;
    job.end = later(start_instant, span);
    job.spin_up = SpinUp::none;
    job.initial_temperature = initial;
    job.step = step;
    Forcing forcing;
    forcing.air.temperature = air;
    forcing.shortwave_down = absorbed;
    forcing.longwave_down = 0.0;
    job.weather = Weather{.instant = {Instant{}}, .sample = {forcing}};
    job.weather.instant[0] = start_instant;
    return job;
}

}  // namespace

TEST_CASE("a half-space that radiates follows Volterra's equation at steps of 1 s to 1 h",
          "[thermal][nonlinear][a10][by_comparison]") {
    // reference/thermal/analytic_cases.md, A10. Thermal effusivity alone matters: k C = 2e6, 3025.
    struct Case {
        double initial, flux, emissivity, kc;
        std::vector<std::pair<double, double>> temperature;
    };
    const Case cool{300.0,
                    0.0,
                    1.0,
                    2e6,
                    {{60, 297.24270688},
                     {600, 291.77910574},
                     {3600, 281.96186568},
                     {21600, 264.2939807},
                     {86400, 244.8719008}}};
    const Case warm{290.0,
                    750.0,
                    0.95,
                    2e6,
                    {{60, 292.22306254},
                     {600, 296.65228186},
                     {3600, 304.5128263},
                     {21600, 317.2655035},
                     {86400, 327.6878541}}};
    const Case shock{
        100.0,
        1200.0,
        0.95,
        3025.0,
        {{60, 262.696156}, {600, 352.699094}, {3600, 373.764205}, {36000, 382.504688}}};
    for (const Case& c : {cool, warm, shock}) {
        const bool lunar = c.kc < 1e4;
        const Layer deep =
            lunar ? Layer{1.0, 3025.0 / 1.2e6, 1500.0, 800.0} : Layer{5.0, 1.0, 2000.0, 1000.0};
        const double equilibrium = std::pow(c.flux / (c.emissivity * stefan_boltzmann), 0.25);
        const double low = std::min(c.initial, equilibrium),
                     high = std::max(c.initial, equilibrium);
        for (const double step : {1.0, 60.0, 600.0, 3600.0}) {
            const double span = step < 10.0 ? 600.0 : 86400.0;
            PointJob job =
                constant_job({deep}, c.flux, c.emissivity, 0.0, 300.0, c.initial, span, step);
            job.longest_step = step;
            const PointResult result = run_column(job);
            double beyond = 0.0, worst = 0.0;
            for (const PointRow& row : result.row) {
                beyond = std::max(
                    {beyond, row.surface_temperature - high, low - row.surface_temperature});
            }
            for (const auto& [t, kelvin] : c.temperature) {
                if (t > span || std::fmod(t, step) != 0.0) continue;
                const double found = result.row[std::size_t(t / step)].surface_temperature;
                worst = std::max(worst, std::abs(found - kelvin));
            }
            CAPTURE(c.initial, c.flux, step, result.steps, worst);
            CHECK(worst < 0.05);
            CHECK(beyond <= 1e-9);
            CHECK(result.limited == 0);
            CHECK(result.worst_energy_closure < 1e-10);
        }
    }
}

TEST_CASE("water freezes downward as Neumann's solution says",
          "[thermal][nonlinear][a6][by_events][by_comparison]") {
    for (const double cell : {0.002, 0.001}) {
        const FreezingFront front = freezing_front(cell);
        CAPTURE(cell, front.hour, front.day);
        CHECK(front.hour < 0.01);
        CHECK(front.day < 0.002);
        CHECK(front.closure < 1e-10);
    }
}

TEST_CASE("the moon's equator follows the converged curve B1",
          "[thermal][nonlinear][b1][by_comparison]") {
    const auto curve = shared_data("reference/thermal/b1_lunar_equator_240.txt");
    if (!curve) return;
    const LunarDay found = lunar_day(*curve);
    WARN("B1: rms " << found.rms << " K, max " << found.worst << " K, nodes " << found.nodes);
    CHECK(found.rms < 0.2);
    CHECK(found.worst < 1.5);
}

TEST_CASE("snow stays at melting until its meltwater has run off",
          "[thermal][nonlinear][snow][by_events][by_trace]") {
    Layer snow{0.5, 0.2, 300.0, 2090.0};
    snow.law = Melting{.held = 0.0};
    PointJob job = constant_job({snow}, 400.0, 0.0, 10.0, 273.15, 273.15, 86400.0, 3600.0);
    const PointResult result = run_column(job);
    double melted = 0.0;
    for (const PointRow& row : result.row) {
        CHECK(row.surface_temperature <= 273.15 + 1e-9);
        melted += row.melt * 3600.0;
    }
    // The pack starts at melting: nothing but melting can take 400 W/m².
    CHECK(melted == Approx(400.0 * 86400.0).epsilon(1e-6));
    CHECK(result.has_melt);
}
