#include "thermal/surface/standing_water.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/air/moist_air.hpp"
#include "materials/base/units.hpp"
#include "tests/support/column_jobs.hpp"

using namespace diurna;
using namespace column_jobs;

TEST_CASE("rain fills the store, evaporation empties it: no water is lost",
          "[thermal][column_tool][store]") {
    PointJob job = facet_over({deep}, FixedFlux{0.0}, 12.0, 0.95);
    job.spin_up = SpinUp::none;
    job.initial_temperature = 295.0;
    job.step = 120.0;
    job.surface.albedo = 0.2;
    job.surface.store = {.capacity_mm = 2.0, .wet_albedo = 0.1};
    drive(
        job,
        [](double t) { return 700.0 * std::max(0.0, -std::cos(2.0 * std::numbers::pi * t / day)); },
        [](double) { return 295.0; }, 330.0, 600.0);
    for (Forcing& f : job.weather.sample) {
        f.air.vapour_pressure = 900.0;
        f.direct_normal = 0.0;  // overcast: its light is straight between samples
    }
    // Around 2 h, straight down to nothing half an hour off: 1.5 mm in all.
    const auto rain_at_most = [&](double mm_h) {
        for (int i = -3; i <= 3; ++i) {
            job.weather.sample[std::size_t(12 + i)].rain_mm_h = mm_h * (1.0 - std::abs(i) / 3.0);
        }
    };
    rain_at_most(3.0);
    const PointResult result = run_column(job);
    REQUIRE(result.has_store);
    double rain = 0.0, evaporated = 0.0, most = 0.0;
    for (std::size_t i = 1; i < result.row.size(); ++i) {
        const PointRow &a = result.row[i - 1], &b = result.row[i];
        rain += 0.5 * job.step / 3600.0 *
                (job.weather.at(a.instant).rain_mm_h + job.weather.at(b.instant).rain_mm_h);
        // Latent heat is all the store's: the surface itself is dry.
        evaporated -= 0.5 * job.step * (a.latent + b.latent) / latent_heat_of_vaporisation(295.0);
        most = std::max(most, b.water_mm);
        CHECK(b.frost_mm == 0.0);
        CHECK(b.water_mm == Approx(rain - evaporated).margin(0.02));
    }
    CHECK(rain == Approx(1.5).epsilon(1e-9));
    CHECK(evaporated == Approx(1.5).epsilon(0.01));
    CHECK(most > 1.2);
    CHECK(result.row.back().water_mm < 0.01);  // the evening's dew
    // Wet ground is darker by the wet share: half full, half way from 0.2 to 0.1.
    for (const PointRow& row : result.row) {
        const double sun = job.weather.at(row.instant).shortwave_down;
        const double wet = std::min(1.0, row.water_mm / 2.0);
        CHECK(row.absorbed_solar == Approx((0.8 + 0.1 * wet) * sun).margin(0.5));
    }
    CHECK(result.worst_energy_closure < 1e-9);
    // What is more than it holds runs off.
    rain_at_most(30.0);
    double highest = 0.0;
    for (const PointRow& row : run_column(job).row) highest = std::max(highest, row.water_mm);
    CHECK(highest == Approx(2.0).epsilon(1e-6));
}

TEST_CASE("moist air lays frost on a cold roof, the morning takes it off",
          "[thermal][column_tool][frost]") {
    PointJob job = facet_over({{0.01, 1.0, 2000.0, 1000.0}}, FixedFlux{0.0}, 8.0, 0.95);
    job.spin_up = SpinUp::none;
    job.initial_temperature = 271.0;
    job.step = 300.0;
    job.surface.store = {.capacity_mm = 1.0};
    drive(
        job, [](double t) { return t > 43200.0 ? 400.0 : 0.0; }, [](double) { return 272.0; },
        200.0);
    for (Forcing& f : job.weather.sample) {
        f.air.vapour_pressure = 0.95 * saturation_vapour_pressure(272.0);
    }
    const PointResult result = run_column(job);
    double laid = 0.0;
    for (std::size_t i = 1; i <= 144; ++i) {
        laid += 0.5 * job.step * (result.row[i - 1].latent + result.row[i].latent) / 2.8345e6;
    }
    const PointRow& noon = result.row[144];
    CHECK(noon.surface_temperature < 271.0);
    CHECK(noon.frost_mm > 0.1);
    CHECK(noon.frost_mm == Approx(laid).epsilon(0.02));
    CHECK(noon.water_mm == 0.0);
    CHECK(result.row.back().frost_mm == Approx(0.0).margin(1e-9));
    // Melting takes its heat once: what frost melted, 0.3337 MJ/kg.
    double melted = 0.0;
    for (const PointRow& row : result.row) melted += row.melt * job.step;
    CHECK(melted > 0.0);
    CHECK(melted <= noon.frost_mm * 3.337e5 * 1.01);
    CHECK(result.limited == 0);
}

TEST_CASE("lying water freezes with its heat and melts with it", "[thermal][column_tool][frost]") {
    // 2 mm on a plate that stores little: from +5 to −6 °C of air and back, without vapour's part.
    // A night takes 2 kg/m² · 333.7 kJ/kg from the water, and the day gives it back.
    PointJob job = facet_over({{0.002, 1.0, 100.0, 100.0}}, FixedFlux{0.0}, 15.0, 0.0);
    job.spin_up = SpinUp::none;
    job.initial_temperature = 278.0;
    job.step = 600.0;
    job.surface.store = {.capacity_mm = 2.0};
    drive(
        job, [](double) { return 0.0; },
        [](double t) { return 272.65 + 5.5 * std::cos(2.0 * std::numbers::pi * t / day); }, 0.0);
    for (std::size_t i = 0; i < job.weather.sample.size(); ++i) {
        Forcing& f = job.weather.sample[i];
        f.rain_mm_h = i < 12 ? 4.0 : 0.0;  // an hour in the mild evening
        f.air.vapour_pressure = 611.0;     // at freezing neither dew nor evaporation
    }
    const PointResult result = run_column(job);
    double frozen = 0.0, lying = 0.0, most_frost = 0.0, coldest_wet = 400.0;
    for (std::size_t i = 1; i < result.row.size(); ++i) {
        const PointRow& row = result.row[i];
        if (row.melt < 0.0 && frozen == 0.0) lying = result.row[i - 1].water_mm;
        if (row.melt < 0.0) frozen -= row.melt * job.step;
        most_frost = std::max(most_frost, row.frost_mm);
        if (row.water_mm > 0.2) coldest_wet = std::min(coldest_wet, row.surface_temperature);
    }
    CAPTURE(most_frost, lying, frozen, coldest_wet);
    CHECK(most_frost > 1.9);
    CHECK(lying > 1.5);
    CHECK(frozen == Approx(lying * 3.337e5).epsilon(0.03));
    CHECK(coldest_wet > 270.0);  // water holds the plate while it freezes; the air goes to 267 K
    CHECK(result.row.back().frost_mm < 0.1);
    CHECK(result.worst_energy_closure < 1e-10);
    CHECK(result.limited == 0);
}

TEST_CASE("precipitation is snow below 0 °C, rain above 2 °C", "[thermal][snow]") {
    CHECK(snow_share(270.0) == 1.0);
    CHECK(snow_share(274.15) == Approx(0.5));
    CHECK(snow_share(276.0) == 0.0);
}

TEST_CASE("snow's albedo ages by Douville's rates and is renewed by 10 mm", "[thermal][snow]") {
    // ISBA's snow (Douville et al. 1995): 0.008 a day dry, e^(−0.24 t) towards 0.5 melting; 0.85
    // new.
    const AgeingAlbedo law;
    CHECK(aged_albedo(law, 0.85, false, 0.0, 10.0 * 86400.0) == Approx(0.77).epsilon(1e-12));
    CHECK(aged_albedo(law, 0.85, false, 0.0, 100.0 * 86400.0) == Approx(0.50).epsilon(1e-12));
    CHECK(aged_albedo(law, 0.85, true, 0.0, 86400.0 / 0.24) ==
          Approx(0.5 + 0.35 * std::exp(-1.0)).epsilon(1e-12));
    CHECK(aged_albedo(law, 0.5, false, 10.0, 60.0) == Approx(0.85).margin(1e-5));
    CHECK(aged_albedo(law, 0.8, false, 30.0, 60.0) == 0.85);
    double stepwise = 0.85;
    for (int i = 0; i < 1000; ++i) stepwise = aged_albedo(law, stepwise, true, 0.0, 864.0);
    CHECK(stepwise == Approx(aged_albedo(law, 0.85, true, 0.0, 864000.0)).epsilon(1e-12));
}

TEST_CASE(
    "a snow field darkens in the cold by days, faster when it melts, and fresh snow whitens it",
    "[thermal][column_tool][snow]") {
    const double air = GENERATE(263.15, 275.65);
    PointJob job =
        facet_over({{0.5, 0.2, 300.0, 2090.0, Melting{}}}, FixedTemperature{273.15}, 12.0, 0.98);
    job.surface.albedo = 0.85;
    job.surface.snow_albedo = AgeingAlbedo{};
    job.spin_up = GENERATE(SpinUp::none, SpinUp::first_day);
    job.initial_temperature = std::min(air, 273.15);
    job.end = later(job.start, 6.0 * day);
    job.step = 43200.0;
    drive(
        job, [](double) { return 200.0; }, [&](double) { return air; }, 300.0, 3600.0);
    // 0.6 mm within the sixth day's first six hours: as snow at −10 °C, as rain at +2.5 °C.
    for (std::size_t i = 121; i < 127; ++i) job.weather.sample[i].rain_mm_h = 0.1;
    const PointResult result = run_column(job);
    const auto albedo = [&](std::size_t row) {
        return 1.0 - result.row[row].absorbed_solar / 200.0;
    };
    CAPTURE(air, int(job.spin_up));
    CHECK(albedo(0) == Approx(0.85).margin(1e-9));  // the spin-up did not age it
    if (air < 273.15) {
        CHECK(albedo(10) == Approx(0.85 - 5.0 * 0.008).margin(1e-4));
        CHECK(albedo(12) == Approx(0.85 - 6.0 * 0.008 + 0.06 * 0.35).margin(5e-4));
    } else {
        CHECK(result.row[10].surface_temperature == Approx(273.15).margin(1e-6));
        CHECK(albedo(10) < 0.5 + 0.35 * std::exp(-0.24 * 4.0));
        CHECK(albedo(10) >= 0.5 + 0.35 * std::exp(-0.24 * 5.0) - 1e-6);
        CHECK(albedo(12) < albedo(10));
    }
}
