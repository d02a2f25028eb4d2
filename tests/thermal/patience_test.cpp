#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>

#include "materials/air/moist_air.hpp"
#include "tests/support/column_jobs.hpp"
#include "thermal/point/point_facet.hpp"
#include "thermal/surface/turbulence.hpp"

// What a facet is asked to follow may be absurd; it is followed, or given up with words, and never
// tried for ever.

using namespace diurna;
using namespace column_jobs;

namespace {

/// A layer at the edges of what is read (materials/matter/read_layers.cpp), or in between.
Layer edge_layer(std::mt19937& random) {
    const auto edge = [&](double least, double most) {
        const double unit = double(random() % 1000) / 999.0;
        return random() % 3 == 0   ? least
               : random() % 2 == 0 ? most
                                   : least * std::pow(most / least, unit);
    };
    Layer layer{edge(1e-5, 100.0), edge(0.005, 500.0), edge(0.1, 25000.0), edge(50.0, 2e4)};
    if (random() % 4 == 0) {
        layer.law = Freezing{.water = edge(1.0, 1000.0),
                             .frozen_conductivity = edge(0.005, 500.0),
                             .frozen_heat_capacity = edge(50.0, 2e4)};
    }
    return layer;
}

/// Weather at the edges of what is read (thermal/weather_file/quantity.cpp), another edge each
/// hour.
Forcing edge_weather(std::mt19937& random) {
    const auto either = [&](double least, double most) { return random() % 2 ? least : most; };
    Forcing f;
    f.air = {.temperature = either(100.0, 400.0),
             .pressure = either(3e4, 1.1e5),
             .vapour_pressure = 0.0};
    f.air.vapour_pressure = std::min(
        0.2 * f.air.pressure, either(0.0, 1.1) * saturation_vapour_pressure(f.air.temperature));
    f.wind_speed = either(0.0, 120.0);
    f.shortwave_down = either(0.0, 2500.0);
    f.longwave_down = either(0.0, 1000.0);
    f.rain_mm_h = either(0.0, 2000.0);
    return f;
}

PointJob edge_job(std::mt19937& random) {
    PointJob job = facet_over({edge_layer(random)}, FixedFlux{0.0}, 0.0, double(random() % 2));
    if (random() % 2) job.surface.layers.push_back(edge_layer(random));
    job.surface.convection = Louis{};
    job.surface.albedo = double(random() % 2);
    job.surface.roughness_length = 0.01;
    job.surface.heat_roughness_length = 0.001;
    if (random() % 3 == 0) job.surface.bottom = FixedTemperature{random() % 2 ? 10.0 : 3000.0};
    if (random() % 3 == 0) job.surface.store = {.capacity_mm = random() % 2 ? 0.01 : 1000.0};
    if (random() % 4 == 0) job.surface.evaporation = {.minimum_resistance = 0.0, .wetness = 1.0};
    job.spin_up = SpinUp::none;
    job.end = later(job.start, 6 * 3600.0);
    job.step = 3600.0;
    for (int hour = 0; hour <= 6; ++hour) {
        job.weather.instant.push_back(later(job.start, 3600.0 * hour));
        job.weather.sample.push_back(edge_weather(random));
    }
    return job;
}

}  // namespace

TEST_CASE("what is absurd but may be read is followed in a bounded number of steps",
          "[thermal][column_tool][stress][by_extreme]") {
    constexpr unsigned seed = 20261123;
    constexpr int cases = 80;
    std::mt19937 random(seed);
    int given_up = 0;
    for (int i = 0; i < cases; ++i) {
        const PointJob job = edge_job(random);
        CAPTURE(seed, i);
        PointResult result;
        try {
            result = run_column(job);
        } catch (const std::runtime_error& error) {
            CHECK_THAT(error.what(),
                       Catch::StartsWith("the heat balance makes no progress at 2020-06-01T0"));
            ++given_up;
            continue;
        }
        CHECK(result.steps + result.rejected < 40000);
        for (const PointRow& row : result.row) {
            CHECK(row.surface_temperature > 1.0);  // false of what is no number
            CHECK(row.surface_temperature < 5000.0);
            CHECK(std::isfinite(row.conducted + row.sensible + row.latent + row.melt));
        }
        CHECK(result.worst_energy_closure < 1e-6);  // 1e9 J/m2 in steps of microseconds
    }
    CAPTURE(given_up);
    CHECK(given_up < cases / 10);
}

TEST_CASE("a balance that no step solves ends with an error and its instant",
          "[thermal][column_tool]") {
    ThermalSurface surface;
    surface.layers = {deep};
    surface.roughness_length = 0.01;
    surface.heat_roughness_length = 0.001;
    const LouisForm louis =
        louis_form(surface.roughness_length, surface.heat_roughness_length, 10.0, 2.0);
    const Instant start = parse_instant("2026-06-20T00:00:00Z"), noon = later(start, 43200.0);
    // From noon on what comes in is no number.
    PointFacet facet({.surface = surface,
                      .louis = louis,
                      .grid = point_grid(surface),
                      .forcing = [&](Instant when) {
                          PointForcing now;
                          now.air = {.temperature = 290.0, .pressure = 1e5, .vapour_pressure = 1e3};
                          now.wind_speed = 2.0;
                          now.longwave_in =
                              when < noon ? 300.0 : std::numeric_limits<double>::quiet_NaN();
                          return now;
                      }});
    for (double& u : facet.u) u = facet.column.state_of(0, 290.0);
    CHECK_NOTHROW(facet.advance(start, later(start, 3600.0)));
    CHECK_THROWS_WITH(facet.advance(later(start, 3600.0), later(start, 86400.0)),
                      Catch::Contains("the heat balance makes no progress at 2026-06-20T1") &&
                          Catch::Contains("steps tried"));

    // Stepped without a look at its error, it stands still and counts.
    PointFacet marching = facet;
    marching.count = {};
    marching.march(noon, later(noon, 600.0), true);
    CHECK(marching.count.unsolved > 0);
    CHECK(marching.count.first_unsolved >= noon);
}
