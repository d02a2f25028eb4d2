#include "thermal/solve/solver.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "tests/support/hill_world.hpp"

using namespace diurna;
using namespace hill_world;

TEST_CASE("a day on mixed ground closes on itself, its energy balanced at every step",
          "[thermal][solver][energy]") {
    const World world(16);
    const SolveResult result = world.run({.start = june});
    const SolveReport& report = result.report;
    CHECK(report.converged);
    CHECK(report.passes <= 6);
    CHECK(report.periodic_residual <= 1e-4);
    CHECK(report.estimated_error <= 0.01);
    CHECK(report.exchange_change <= 0.5);
    CHECK(report.worst_energy_closure < 1e-11);
    // Newton swings only where dew turns to evaporation: one facet and step in a thousand.
    CHECK(double(report.bisections) < 1e-3 * double(report.facets) * report.steps);
    CHECK(report.coldest > 275.0);
    CHECK(report.warmest < 350.0);
    CHECK(result.temperature.instant.size() == 25);
    // The last instant is the first of the next day.
    const auto first = result.temperature.at(0), last = result.temperature.at(24);
    for (std::size_t f = 0; f < world.facets.size(); ++f) {
        REQUIRE(std::abs(first[f] - last[f]) < 2e-4f);
    }
}

TEST_CASE("spinning up for sixty days leads to what Newton on the period finds",
          "[thermal][solver][periodic]") {
    const World world(6);
    Weather sixty;
    for (int d = 0; d < 60; ++d) {
        for (int h = 0; h < 24; ++h) {
            sixty.instant.push_back(later(june, 86400.0 * d + 3600.0 * h));
            sixty.sample.push_back(world.weather.sample[std::size_t(h)]);
        }
    }
    // A bare, open facet with nothing but the same sky, of the thin roof (a room below) and of 0.4
    // m of soil: 3 m of it would settle by a factor of e in 92 days. The sun's declination drifts,
    // so the sun is switched off in both.
    const std::uint16_t material = GENERATE(2, 4);
    std::vector<Material> all;
    for (std::size_t i = 0; i < 4; ++i) all.push_back(world.materials[MaterialId(i)]);
    all.push_back(
        ground("thin soil", 0.2, 0.96, Louis{}, {{0.4, 0.9, 1500.0, 1300.0}}, FixedFlux{0.0}));
    const MaterialLibrary materials(all);
    FacetSet flat;
    append_facets(flat, std::vector<Eigen::Vector3d>{{0, 0, 0}, {10, 0, 0}, {0, 10, 0}},
                  std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}},
                  std::vector<MaterialId>{MaterialId{material}}, ObjectId{0});
    const FacetViews open{
        .sky = {1.0f}, .below = {0.0f}, .others = {.row = {0, 0}, .facet = {}, .factor = {}}};
    for (auto* weather : {&sixty}) {
        for (Forcing& f : weather->sample) f.shortwave_down = 0.0;
    }
    Weather one = world.weather;
    for (Forcing& f : one.sample) f.shortwave_down = 0.0;
    const SunExposure no_shadow;
    const auto run = [&](const Weather& weather, SolveOptions options) {
        return solve({.facets = flat,
                      .views = open,
                      .sun = no_shadow,
                      .materials = materials,
                      .weather = weather,
                      .site = tennessee},
                     options);
    };
    const auto periodic = run(one, {.start = june, .keep_every = 600.0});
    const auto spun = run(
        sixty, {.start = june, .duration = 59.0 * 86400.0, .keep_every = 600.0, .periodic = false});
    const std::size_t day = 144;
    for (std::size_t i = 0; i <= day; ++i) {
        CAPTURE(i);
        REQUIRE(periodic.temperature.kelvin[i] ==
                Approx(spun.temperature.kelvin[58 * day + i]).margin(2e-3));
    }
    CHECK(periodic.report.converged);
}

TEST_CASE("ground, sky and air of one temperature stay so: nothing flows",
          "[thermal][solver][furnace]") {
    World world(12);
    Forcing still;
    still.air.temperature = 300.0;
    still.air.vapour_pressure = saturation_vapour_pressure(300.0);
    still.wind_speed = 3.0;
    still.shortwave_down = 0.0;
    still.longwave_down = stefan_boltzmann * power4(300.0);
    world.weather = Weather{.instant = {Instant{}}, .sample = {still}};
    std::vector<Material> same;
    for (std::size_t i = 0; i < 4; ++i) {
        Material material = world.materials[MaterialId(i)];
        if (i == 2) material.thermal.bottom = Interior{300.0, 7.7};
        if (i == 3) material.thermal.bottom = FixedTemperature{300.0};
        same.push_back(material);
    }
    world.materials = MaterialLibrary(same);
    const SolveResult result = world.run({.start = june});
    CHECK(result.report.converged);
    // A net flux of 1e-6 W/m² would move the thin roof, whose films pass 10 W/m²K, by 1e-7 K.
    CHECK(std::abs(result.report.coldest - 300.0) < 1e-7);
    CHECK(std::abs(result.report.warmest - 300.0) < 1e-7);
    CHECK(result.report.exchange_change < 1e-9);
}

TEST_CASE("one, two and four threads write the same bytes",
          "[thermal][solver][threads][by_replication]") {
    const World world(10);
    set_thread_count(1);
    const SolveResult one = world.run({.start = june});
    for (const int threads : {2, 4}) {
        set_thread_count(threads);
        const SolveResult other = world.run({.start = june});
        CHECK(std::memcmp(one.temperature.kelvin.data(), other.temperature.kelvin.data(),
                          one.temperature.kelvin.size() * sizeof(float)) == 0);
        CHECK(one.report.passes == other.report.passes);
        CHECK(one.report.worst_energy_closure == other.report.worst_energy_closure);
    }
    set_thread_count(0);
}

TEST_CASE("a quick solve is within half of its tolerance, on any number of threads",
          "[thermal][solver][threads][quick][by_replication]") {
    const World world(16);
    const bool exchange = GENERATE(true, false);
    const SolveOptions plain{.start = june, .keep_every = 600.0, .exchange = exchange};
    SolveOptions finest = plain;
    finest.refinement = 4;
    finest.mode_error = 0.001;
    finest.tolerance = 1e-6;
    const SolveResult exact = world.run(finest);
    set_thread_count(1);
    const SolveResult one = world.run(quick(plain, 0.1));
    set_thread_count(3);
    const SolveResult three = world.run(quick(plain, 0.1));
    set_thread_count(0);
    double squares = 0.0;
    for (std::size_t i = 0; i < exact.temperature.kelvin.size(); ++i) {
        const double apart = double(one.temperature.kelvin[i]) - exact.temperature.kelvin[i];
        squares += apart * apart / double(exact.temperature.kelvin.size());
    }
    CAPTURE(exchange, one.report.passes, one.report.estimated_error);
    CHECK(std::sqrt(squares) < 0.05);
    CHECK(one.report.converged);
    CHECK(one.report.estimated_error <= one.report.limit);
    CHECK(one.report.passes < exact.report.passes);
    CHECK(std::memcmp(one.temperature.kelvin.data(), three.temperature.kelvin.data(),
                      one.temperature.kelvin.size() * sizeof(float)) == 0);
    // No tolerance, no change.
    CHECK_FALSE(quick(plain, 0.0).quick);
    CHECK(quick(plain, 0.0).mode_error == plain.mode_error);
    CHECK(quick(plain, 5.0).mode_error == quick(plain, 0.1).mode_error);
}

TEST_CASE("halving the step quarters what is left of its error", "[thermal][solver][order]") {
    // Smooth forcing: no sun, so no sunrise, no shadow.
    World world(6);
    for (Forcing& f : world.weather.sample) f.shortwave_down = 0.0;
    // Hourly samples make kinks; fill the day in between.
    Weather smooth;
    for (int i = 0; i <= 1440; ++i) {
        const double wave = std::cos(2.0 * M_PI * (i / 60.0 - 15.0) / 24.0);
        Forcing f = world.weather.sample[0];
        f.air.temperature = 297.0 + 6.0 * wave;
        f.wind_speed = 2.5 + 1.5 * wave;
        smooth.instant.push_back(later(june, 60.0 * i));
        smooth.sample.push_back(f);
    }
    world.weather = smooth;
    const auto at = [&](double step) {
        return world.run({.start = june, .step = step, .keep_every = 7200.0, .exchange = false});
    };
    const auto finest = at(112.5);
    const double coarse = worst_difference(at(1800.0).temperature, finest.temperature);
    const double fine = worst_difference(at(900.0).temperature, finest.temperature);
    CAPTURE(coarse, fine);
    CHECK(coarse < 0.5);
    CHECK(std::log2(coarse / fine) > 1.7);
}

TEST_CASE("a solve refuses arrays that do not belong together", "[thermal][solver][errors]") {
    const World world(4);
    FacetViews other = world.view;
    other.sky.pop_back();
    const SunExposure sun;
    CHECK_THROWS_AS(solve({.facets = world.facets,
                           .views = other,
                           .sun = sun,
                           .materials = world.materials,
                           .weather = world.weather,
                           .site = tennessee},
                          {.start = june}),
                    InputError);
    CHECK_THROWS_AS(solve({.facets = world.facets,
                           .views = world.view,
                           .sun = sun,
                           .materials = world.materials,
                           .weather = world.weather,
                           .site = tennessee},
                          {.start = june, .step = 0.0}),
                    InputError);
}

// Unsworth & Monteith (1975): beyond its view times the horizontal flux a wall sees ½ b ln 2 σ T⁴
// of a clear sky, b = 0.09; level ground keeps the flux. Black plates that only radiate settle
// where σ T⁴ is what arrives.
TEST_CASE("a wall is warmed by the brighter sky near the horizon, level ground is not",
          "[thermal][solver][tilt]") {
    FacetSet facets;
    const std::vector<Eigen::Vector3d> vertex{{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                              {5, 0, 0}, {6, 0, 0}, {5, 0, 1}};
    const std::vector<std::array<std::uint32_t, 3>> triangle{{0, 1, 2}, {3, 4, 5}};
    const std::vector<MaterialId> material{MaterialId{0}, MaterialId{0}};
    append_facets(facets, vertex, triangle, material, ObjectId{0});
    FacetViews view;
    view.sky = {1.0f, 0.5f};
    view.below = {0.0f, 0.5f};
    view.others.row = {0, 0, 0};
    const MaterialLibrary materials({ground("plate", 0.0, 1.0, ConstantFilm{0.0},
                                            {{0.01, 10.0, 1000.0, 1000.0}}, FixedFlux{0.0})});
    Forcing forcing;
    forcing.air = {.temperature = 290.0, .pressure = 1e5, .vapour_pressure = 1000.0};
    forcing.shortwave_down = 0.0;
    forcing.longwave_down = clear_longwave(forcing.air);
    const auto settled = [&](bool by_direction) {
        const SunExposure sun;
        const SolveResult result =
            solve({.facets = facets,
                   .views = view,
                   .sun = sun,
                   .materials = materials,
                   .weather = Weather{.instant = {Instant{}}, .sample = {forcing}},
                   .site = tennessee,
                   .elevation = 400.0,
                   .clear_sky = {.longwave_by_direction = by_direction}},
                  {.start = june, .exchange = false});
        CHECK(result.report.converged);
        const auto kelvin = result.temperature.at(5);
        return std::array<double, 2>{stefan_boltzmann * power4(double(kelvin[0])),
                                     stefan_boltzmann * power4(double(kelvin[1]))};
    };
    const auto even = settled(false), tilted = settled(true);
    CHECK(even[0] == Approx(forcing.longwave_down).epsilon(1e-4));
    CHECK(tilted[0] == Approx(even[0]).margin(0.01));
    CHECK(tilted[1] - even[1] ==
          Approx(0.5 * 0.09 * std::log(2.0) * stefan_boltzmann * power4(290.0)).epsilon(0.01));
}

// Sheet metal over soil, each seeing the other two: what one gains of warmth the others answer.
TEST_CASE("thin plates that see each other settle within six passes, by the error reported",
          "[thermal][solver][exchange]") {
    FacetSet facets;
    const std::vector<Eigen::Vector3d> vertex{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1},
                                              {0, 1, 1}, {3, 0, 0}, {3, 1, 0}, {3, 0, 1}};
    append_facets(
        facets, vertex, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}},
        std::vector<MaterialId>{MaterialId{0}, MaterialId{1}, MaterialId{1}}, ObjectId{0});
    const FacetViews view{.sky = {0.4f, 0.3f, 0.3f},
                          .below = {0.0f, 0.0f, 0.0f},
                          .others = {.row = {0, 2, 4, 6},
                                     .facet = {1, 2, 0, 2, 0, 1},
                                     .factor = {0.3f, 0.3f, 0.3f, 0.4f, 0.3f, 0.4f}}};
    Material sheet =
        ground("sheet", 0.3, 0.9, Tarp{}, {{0.0015, 45.0, 7800.0, 500.0}}, FixedFlux{0.0});
    sheet.thermal.back = ExposedBack{.emissivity = 0.9, .albedo = 0.3};
    const MaterialLibrary materials({mixed()[MaterialId{0}], sheet});
    const Weather weather = summer();
    const auto run = [&](double tolerance, int passes) {
        return solve({.facets = facets,
                      .views = view,
                      .sun = {},
                      .materials = materials,
                      .weather = weather,
                      .site = tennessee,
                      .elevation = 400.0},
                     {.start = june, .max_passes = passes, .tolerance = tolerance});
    };
    const SolveResult usual = run(1e-4, 6), exact = run(1e-9, 40);
    CHECK(usual.report.converged);
    CHECK(usual.report.estimated_error <= 0.01);
    // Floats of 300 K lie 3e-5 K apart.
    CHECK(worst_difference(usual.temperature, exact.temperature) <=
          usual.report.estimated_error + 1e-4);
}
