#include <catch2/catch.hpp>
#include <cmath>

#include "terrain/visibility/view_factors.hpp"
#include "thermal/point/run_column.hpp"
#include "thermal/solve/facet_point.hpp"
#include "thermal/solve/solver.hpp"

using namespace diurna;

namespace {

const Instant january_first = parse_instant("2026-01-01T00:00:00Z");

/// A polar night over saturated air: hoar gathers at every hour and nothing takes it off.
Weather polar_night() {
    Weather weather;
    for (int h = 0; h <= 24; ++h) {
        Forcing f;
        const double wave = std::cos(2.0 * M_PI * (h - 14) / 24.0);
        // 150 to 185 Pa over ice at 257 to 259 K (Murray 1967)
        f.air = {.temperature = 258.0 + wave, .pressure = 85000.0, .vapour_pressure = 160.0};
        f.wind_speed = 3.0 + wave;
        f.longwave_down = 170.0 + 10.0 * wave;
        weather.instant.push_back(later(january_first, 3600.0 * h));
        weather.sample.push_back(f);
    }
    return weather;
}

Material slab() {
    Material plate;
    plate.name = "slab";
    plate.thermal.albedo = 0.3;
    plate.thermal.emissivity = 0.95;
    plate.thermal.layers = {{0.3, 1.5, 2300.0, 900.0}};
    plate.thermal.roughness_length = 0.01;
    plate.thermal.heat_roughness_length = 0.001;
    plate.thermal.store = {.capacity_mm = 0.5};
    return plate;
}

SolveResult solve_plate(double step) {
    const MaterialLibrary materials({slab()});
    FacetSet facets;
    append_facets(facets, std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                  std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}},
                  std::vector<MaterialId>{MaterialId{0}}, ObjectId{0});
    FacetViews view;
    view.sky = {1.0f};
    view.below = {0.0f};
    view.others.row = {0, 0};
    const SunExposure sun;
    const Weather weather = polar_night();
    return solve({.facets = facets,
                  .views = view,
                  .sun = sun,
                  .materials = materials,
                  .weather = weather,
                  .site = {.latitude_deg = 75.0, .longitude_deg = 20.0, .height = 1500.0},
                  .elevation = 1500.0},
                 {.start = january_first, .step = step});
}

}  // namespace

TEST_CASE("hoar that grows from day to day leaves temperatures a repeated day",
          "[thermal][solve][frost]") {
    const double step = GENERATE(300.0, 600.0, 1800.0, 3600.0);
    CAPTURE(step);
    const SolveResult result = solve_plate(step);
    const SolveReport& report = result.report;
    CAPTURE(report.passes, report.periodic_residual, report.estimated_error, report.store_growth);
    CHECK(report.converged);
    CHECK(report.passes <= 6);
    CHECK(report.periodic_residual <= 1e-4);
    REQUIRE(report.stores_held == 1);
    CHECK(report.alternating == 0);
    // What the surface lacks of the sky's 170 W/m² is 40 to 90 W/m²; were all of it made good by
    // hoar, that would be 1.2 to 2.7 mm a day (2.83 MJ/kg), and air takes the larger part.
    CHECK(report.store_growth > 0.1);
    CHECK(report.store_growth < 2.7);
    // The column repeats; the skin of the hoar is warmer or colder by what the hoar of one day, of
    // 200 kg/m³ and 0.10 W/mK, lets through at most.
    const auto& kelvin = result.temperature.kelvin;
    CHECK(std::abs(kelvin.front() - kelvin.back()) < 90.0 * report.store_growth / 200.0 / 0.10);
}

TEST_CASE("a column under hoar that grows from day to day begins after eight days of it",
          "[thermal][point][frost]") {
    PointJob job;
    job.surface = slab().thermal;
    job.weather = polar_night();
    job.site = {.latitude_deg = 75.0, .longitude_deg = 20.0, .height = 1500.0};
    job.start = january_first;
    job.end = later(january_first, 86400.0);
    job.step = 600.0;
    job.spin_up = SpinUp::periodic;
    const PointResult result = run_column(job);
    CAPTURE(result.passes, result.periodic_residual, result.periodic_error);
    CHECK(result.converged);
    CHECK(result.store_held);
    CHECK(result.periodic_error <= job.tolerance);
    // The hoar of a day is the day's latent heat over that of sublimation, 2.836 MJ/kg at -15 C
    // (Murphy & Koop 2005, eq. 5); it has stood eight times as long at the start.
    double latent = 0.0;  // [J m-2]
    for (std::size_t i = 1; i < result.row.size(); ++i) {
        latent += 0.5 * job.step * (result.row[i - 1].latent + result.row[i].latent);
    }
    const double grown = result.row.back().frost_mm - result.row.front().frost_mm;
    CHECK(grown == Approx(latent / 2.836e6).epsilon(0.005));
    CHECK(result.row.front().frost_mm == Approx(8.0 * grown).epsilon(0.05));
    // Below the hoar the day repeats.
    CHECK(result.final_profile.back() == Approx(result.row.front().back_temperature).margin(2e-3));
}

TEST_CASE("a store is held once eight days have not settled it", "[thermal][solve][frost]") {
    FacetPoint point{.facet = 0, .block = 0, .lane = 0, .start = {}, .end = {}};
    Standing before, after;
    for (point.passes = 1; point.passes <= 8; ++point.passes) {
        before = after;
        after.frost += 0.1;
        CHECK_FALSE(point.store.next(point.passes, before, after));
    }
    CHECK(point.store.held);
    const Standing start = after;
    after.frost += 0.1;
    CHECK(point.store.next(point.passes, start, after));
    CHECK(after.frost == start.frost);
    CHECK(point.store.growth == Approx(0.1));
}

TEST_CASE("a store that dries every day is settled at once", "[thermal][solve][frost]") {
    FacetPoint point{.facet = 0, .block = 0, .lane = 0, .start = {}, .end = {}};
    point.passes = 20;
    Standing after{.water = 5e-4};
    CHECK(point.store.next(point.passes, {}, after));
    CHECK_FALSE(point.store.held);
}

TEST_CASE("days are averaged where 24 passes have not brought them nearer", "[thermal][solve]") {
    FacetPoint point{.facet = 0, .block = 0, .lane = 0, .start = {}, .end = {}};
    for (const double residual : {1.0, 0.4, 0.15}) {  // falls: no reason to
        point.passes += 8;
        point.residual = residual;
        note_alternating(point);
        CHECK_FALSE(point.alternates);
    }
    point.passes += 8;
    point.residual = 0.14;
    note_alternating(point);
    CHECK(point.alternates);
}
