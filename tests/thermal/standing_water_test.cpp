#include "thermal/surface/standing_water.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

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
    CHECK(result.worst_energy_closure < 2e-10);  // 1.23e-10; rounding of its sums
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

namespace {

/// Two days of an exposed facet under weather that is given by the hour.
template <class Sample>
PointJob two_days(double step, const Sample& sample) {
    PointJob job = facet_over({deep}, FixedFlux{0.0}, 12.0, 0.95);
    job.surface.albedo = 0.2;
    job.surface.roughness_length = 0.0005;
    job.spin_up = SpinUp::none;
    job.initial_temperature = 274.0;
    job.end = later(job.start, 2.0 * day);
    job.step = step;
    drive(
        job, [](double) { return 0.0; }, [](double) { return 280.0; }, 280.0, 3600.0);
    for (std::size_t h = 0; h < job.weather.sample.size(); ++h) {
        sample(double(h), job.weather.sample[h]);
    }
    return job;
}

/// Rain and sleet from −3 to +7 °C with sun, on a surface that darkens where it is wet.
PointJob sleet(double step) {
    PointJob job = two_days(step, [](double h, Forcing& f) {
        const double wave = std::cos(2.0 * std::numbers::pi * (h - 14.0) / 24.0);
        f.air.temperature = 274.5 + 5.0 * wave;
        f.air.vapour_pressure = 0.75 * saturation_vapour_pressure(f.air.temperature);
        f.shortwave_down = std::max(0.0, 500.0 * wave);
        f.direct_normal = 0.0;
        f.rain_mm_h = 0.6;
    });
    job.surface.store = {.capacity_mm = 2.0, .wet_albedo = 0.1};
    return job;
}

}  // namespace

TEST_CASE("how often rows are written does not change wet ground",
          "[thermal][column_tool][store]") {
    const PointResult fine = run_column(sleet(60.0));
    CHECK(fine.limited == 0);
    for (const double step : {600.0, 3600.0}) {
        const PointResult coarse = run_column(sleet(step));
        double worst = 0.0;
        for (std::size_t i = 0; i < coarse.row.size(); ++i) {
            const PointRow& same = fine.row[i * std::size_t(step / 60.0)];
            worst = std::max(
                worst, std::abs(same.surface_temperature - coarse.row[i].surface_temperature));
        }
        CAPTURE(step);
        CHECK(worst < 0.02);
    }
}

TEST_CASE("water that falls and condenses evaporates, runs off or lies there",
          "[thermal][column_tool][store]") {
    const PointResult result = run_column(sleet(1800.0));
    const PointRow &first = result.row.front(), &last = result.row.back();
    CHECK(result.water.fallen == Approx(0.6 * 48.0).epsilon(1e-9));
    CHECK(result.water.evaporated > 0.1);
    CHECK(result.water.run_off > 10.0);
    const double lying = last.water_mm + last.frost_mm - first.water_mm - first.frost_mm;
    CHECK(result.water.fallen + result.water.condensed ==
          Approx(result.water.evaporated + result.water.run_off + lying).margin(1e-9));
    CHECK(result.worst_energy_closure < 1e-9);
}

TEST_CASE("snow lies on asphalt, shades it and keeps it warm", "[thermal][column_tool][snow]") {
    // 30 mm within six hours at −8 °C: 15 cm of 200 kg/m³. All but depth / (depth + 5 z0) of it is
    // white then, and what comes up from the ground goes through 0.15 m of 0.10 W/mK.
    PointJob job = two_days(3600.0, [](double h, Forcing& f) {
        f.air.temperature = 265.15;
        f.air.vapour_pressure = saturation_vapour_pressure(264.0);
        f.longwave_down = 220.0;
        f.rain_mm_h = h >= 1.0 && h <= 5.0 ? 6.0 : 0.0;
        f.shortwave_down = 300.0;
        f.direct_normal = 0.0;
    });
    job.surface.albedo = 0.1;
    job.surface.store = {.capacity_mm = 0.5};
    const PointResult result = run_column(job);
    const PointRow& row = result.row[36];
    CHECK(row.frost_mm == Approx(30.0).margin(0.7));
    const double depth = row.frost_mm / 200.0;
    CHECK(row.conducted == Approx((row.ground_temperature - row.surface_temperature) * 0.10 /
                                  (depth * depth / (depth + 0.0025)))
                               .epsilon(1e-3));
    CHECK(row.ground_temperature > row.surface_temperature + 5.0);
    // Fresh at five o'clock, 31 hours older, dry: 0.85 − 0.01 of Douville's.
    CHECK(row.absorbed_solar == Approx(300.0 * (1.0 - 0.84)).margin(4.0));
    CHECK(result.worst_energy_closure < 1e-9);
}

TEST_CASE("snow melts by what it is given, and runs off", "[thermal][column_tool][snow]") {
    // 5 mm fall at −2 °C, then sun and +6 °C take them: 333.7 kJ/kg.
    PointJob job = two_days(600.0, [](double h, Forcing& f) {
        f.air.temperature = h < 4.0 ? 271.15 : 279.15;
        f.air.vapour_pressure = 611.0;  // at freezing neither dew nor evaporation
        f.longwave_down = 310.0;
        f.rain_mm_h = h == 1.0 ? 5.0 : 0.0;  // an hour up, an hour down
        f.shortwave_down = h < 4.0 ? 0.0 : 500.0;
        f.direct_normal = 0.0;
    });
    job.surface.store = {.capacity_mm = 0.5};
    job.initial_temperature = 272.0;
    const PointResult result = run_column(job);
    double melted = 0.0, whitest = 0.0;
    for (const PointRow& row : result.row) {
        melted += row.melt * 600.0;
        whitest = std::max(whitest, row.frost_mm);
        if (row.frost_mm > 2.0) CHECK(row.surface_temperature < 273.15 + 0.5);
    }
    CHECK(whitest == Approx(5.0).margin(0.3));
    CHECK(melted == Approx(5.0 * 3.337e5).epsilon(0.05));
    CHECK(result.row.back().frost_mm < 1e-6);
    CHECK(result.water.run_off > 4.0);
    CHECK(result.limited == 0);
}

TEST_CASE("slopes hold less water and let snow slide", "[thermal][store]") {
    // Kidd 1978: 0.77 mm S^−0.49, S in per cent: a third of the level's at 10 %. EN 1991-1-3:
    // roofs keep snow below 30°, none above 60°.
    const WaterStore paving{.capacity_mm = 0.5};
    const double level = store_capacity(paving, 1.0).water_mm;
    CHECK(level == 0.5);
    CHECK(store_capacity(paving, std::cos(std::atan(0.1))).water_mm / level ==
          Approx(0.249 / 0.77).epsilon(0.01));
    CHECK(store_capacity(paving, 0.0).water_mm == Approx(0.05));
    CHECK(store_capacity({.capacity_mm = 1.0, .leaves = true}, 0.0).water_mm == 1.0);
    const auto caught = [&](double slope_deg) {
        return store_capacity(paving, std::cos(slope_deg * std::numbers::pi / 180.0)).caught;
    };
    CHECK(caught(29.0) == 1.0);
    CHECK(caught(45.0) == Approx(0.5));
    CHECK(caught(60.0) == Approx(0.0).margin(1e-9));
    CHECK(rain_share(1.0, 1.0) == 1.0);
    CHECK(rain_share(0.5, 1.0) == Approx(0.5));  // straight down on a slope of 60°
    CHECK(rain_share(0.0, 1.0) == 0.0);
    CHECK(rain_share(-0.5, 1.0) == 0.0);
    CHECK(rain_share(1.0, 0.25) == 0.25);  // three quarters of it are roofed
}

TEST_CASE("the wet share over a step is that of its equation", "[thermal][store]") {
    // dx = r − e min(x, 1): against ten thousand short steps.
    for (const auto& [x, r, e] : {std::array{0.3, 0.0, 0.5},
                                  {0.3, 0.0, 20.0},
                                  {1.6, 0.0, 3.0},
                                  {1.0, 0.0, 0.0},
                                  {0.0, 2.0, 0.5},
                                  {0.5, 0.4, 8.0},
                                  {40.0, 1.0, 2.0},
                                  {0.0, 0.5, 0.0},
                                  {0.2, 3.0, 2.9}}) {
        double at = x, sum = 0.0;
        constexpr int parts = 100000;
        for (int i = 0; i < parts; ++i) {
            const double next = at + (r - e * std::min(at, 1.0)) / parts;
            sum += 0.5 * (std::min(at, 1.0) + std::min(next, 1.0)) / parts;
            at = next;
        }
        CAPTURE(x, r, e);
        CHECK(mean_wet_share(2.0 * x, 2.0 * r, 2.0 * e, 2.0) == Approx(sum).margin(1e-4));
    }
}
