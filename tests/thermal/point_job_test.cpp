#include "thermal/point/point_job.hpp"
#include "thermal/point/point_csv.hpp"
#include "thermal/point/run_column.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "materials/air/moist_air.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "tests/support/column_jobs.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/scratch_folder.hpp"
#include "thermal/point/point_job_file.hpp"

using namespace diurna;
using namespace column_jobs;

namespace {

const PrivateTempFolder private_temp_folder;

}  // namespace

TEST_CASE("a desert day with constant film follows the converged reference B2",
          "[thermal][column_tool][b2][by_comparison]") {
    // reference/thermal/analytic_cases.md, A16: CVODE extrapolated in space. Half of what is left
    // comes from its σ of 5.67e-8 and from the sun as chords of 5 minutes.
    PointJob job = facet_over({deep}, FixedFlux{0.0}, 10.0, 0.95);
    job.step = 1800.0;
    drive(
        job,
        [](double t) { return 750.0 * std::max(0.0, -std::cos(2.0 * std::numbers::pi * t / day)); },
        [](double t) {
            return 298.15 + 8.0 * std::cos(2.0 * std::numbers::pi * (t - 54000.0) / day);
        },
        330.0);
    const PointResult result = run_column(job);
    const std::vector<std::pair<double, double>> reference{
        {1, 294.1009},  {3, 292.5792},    {5, 292.0031},    {6, 292.0728},  {6.5, 293.8714},
        {7, 296.6394},  {8, 303.1838},    {9, 309.9751},    {10, 316.1945}, {11, 321.2634},
        {12, 324.7690}, {12.5, 325.8470}, {13, 326.4450},   {14, 326.1607}, {15, 323.9119},
        {16, 319.8125}, {18, 307.0559},   {18.5, 304.8424}, {19, 303.3794}, {20, 301.1737},
        {21, 299.3915}, {22, 297.8266},   {24, 295.1737}};
    for (const auto& [hour, kelvin] : reference) {
        CAPTURE(hour);
        CHECK(result.row[std::size_t(hour * 2)].surface_temperature ==
              Approx(kelvin).margin(0.012));
    }
    CHECK(result.periodic_residual < 1e-6);
    CHECK(result.worst_energy_closure < 1e-11);
    CHECK(result.passes <= 4);
}

TEST_CASE("a half-space answers a periodic flux with Carslaw and Jaeger's amplitude and lag",
          "[thermal][column_tool][a2][by_comparison]") {
    struct Case {
        double film, amplitude, lag;
    };
    const auto c = GENERATE(Case{5, 6.253404513, 7734.44768}, Case{15, 3.995923739, 4781.58307},
                            Case{30, 2.534198955, 2995.34995});
    CAPTURE(c.film);
    PointJob job = facet_over({deep}, FixedFlux{0.0}, c.film, 0.0);
    job.step = 600.0;
    drive(
        job, [](double t) { return 100.0 + 100.0 * std::cos(2.0 * std::numbers::pi * t / day); },
        [](double) { return 290.0; }, 0.0);
    const auto wave = harmonic(run_column(job));
    CHECK(std::abs(wave) == Approx(c.amplitude).margin(0.005));
    CHECK(-std::arg(wave) / (2.0 * std::numbers::pi) * day == Approx(c.lag).margin(10.0));
}

TEST_CASE("a layered road answers each harmonic as its thermal quadrupoles say",
          "[thermal][column_tool][a3][by_comparison]") {
    struct Case {
        int order;
        double amplitude, lag_deg;  // of T per 100 W/m², film 15
    };
    const auto c = GENERATE(Case{1, 3.844736725, 23.1351252}, Case{2, 3.143510356, 26.5377599},
                            Case{4, 2.53084319, 29.4006958}, Case{8, 1.996416333, 32.6131213},
                            Case{24, 1.287797341, 37.1560183});
    CAPTURE(c.order);
    PointJob job = facet_over(
        {{0.10, 1.2, 2100.0, 1000.0}, {0.30, 0.8, 1600.0, 1000.0}, {5.0, 1.0, 2000.0, 1000.0}},
        FixedFlux{0.0}, 15.0, 0.0);
    job.step = 300.0;
    drive(
        job,
        [&](double t) {
            return 100.0 + 100.0 * std::cos(2.0 * std::numbers::pi * c.order * t / day);
        },
        [](double) { return 290.0; }, 0.0, 60.0);
    const auto wave = harmonic(run_column(job), c.order);
    CHECK(std::abs(wave) == Approx(c.amplitude).epsilon(0.002));
    CHECK(degrees(-std::arg(wave)) == Approx(c.lag_deg).margin(0.2));
}

TEST_CASE("a periodic surface temperature draws the half-space's flux",
          "[thermal][column_tool][a1]") {
    // Film so strong that the surface is the air: amplitude 10 K draws 120.6 W/m², 3 h early.
    PointJob job = facet_over({deep}, FixedFlux{0.0}, 1e4, 0.0);
    job.step = 600.0;
    drive(
        job, [](double) { return 0.0; },
        [](double t) { return 293.15 + 10.0 * std::cos(2.0 * std::numbers::pi * t / day); }, 0.0,
        60.0);
    const PointResult result = run_column(job);
    std::complex<double> sum = 0.0;
    const std::size_t n = result.row.size() - 1;
    for (std::size_t i = 0; i < n; ++i) {
        sum -= result.row[i].conducted *
               std::polar(2.0 / double(n), -2.0 * std::numbers::pi * double(i) / double(n));
    }
    CHECK(std::abs(sum) == Approx(120.6002091).epsilon(0.005));
    CHECK(std::arg(sum) / (2.0 * std::numbers::pi) * day == Approx(10800.0).margin(60.0));
}

TEST_CASE("steps of flux and air warm a half-space and a slab as in Carslaw and Jaeger",
          "[thermal][column_tool][a4][by_comparison]") {
    struct Case {
        double film, flux, air;
        std::vector<Layer> layers;
        std::vector<std::pair<double, double>> warming;  // s, K
    };
    const Case flux{
        0.0,
        400.0,
        300.0,
        {deep},
        {{60, 2.472154893}, {600, 7.81764019}, {3600, 19.14922946}, {21600, 46.90584114}}};
    const Case film{20.0,
                    0.0,
                    301.0,
                    {deep},
                    {{60, 0.1125290806},
                     {600, 0.2962095709},
                     {3600, 0.5271940959},
                     {21600, 0.7527336015},
                     {86400, 0.8679046715}}};
    const Case slab{0.0,
                    400.0,
                    300.0,
                    {{0.1, 1.2, 2100.0, 1000.0}},
                    {{60, 2.202370623}, {600, 6.96450742}, {3600, 17.08089675}}};
    for (const Case& c : {flux, film, slab}) {
        PointJob job = facet_over(c.layers, FixedFlux{0.0}, c.film, 0.0);
        job.spin_up = SpinUp::none;
        job.initial_temperature = 300.0;
        job.step = 60.0;
        drive(
            job, [&](double) { return c.flux; }, [&](double) { return c.air; }, 0.0);
        const PointResult result = run_column(job);
        for (const auto& [t, warming] : c.warming) {
            CAPTURE(c.film, c.layers.size(), t);
            const double found = result.row[std::size_t(t / 60.0)].surface_temperature - 300.0;
            CHECK(found == Approx(warming).epsilon(0.003));
        }
    }
}

TEST_CASE("a thin plate with air behind loses heat on both sides",
          "[thermal][column_tool][plate]") {
    // Steady: 500 W/m² absorbed, two films of 10, both sides radiating at 0.9; the steel's own drop
    // is 0.01 K. 2 h (T − 300) + ε σ (2 T⁴ − L/σ − 300⁴) = 500, by bisection: the test's own root.
    PointJob job = facet_over({{0.001, 50.0, 7800.0, 500.0}}, FixedFlux{0.0}, 10.0, 0.9);
    job.surface.back = ExposedBack{.emissivity = 0.9, .albedo = 0.9};
    drive(
        job, [](double) { return 500.0; }, [](double) { return 300.0; }, 350.0);
    double low = 300.0, high = 400.0;
    for (int i = 0; i < 60; ++i) {
        const double t = 0.5 * (low + high);
        const double loss = 20.0 * (t - 300.0) +
                            0.9 * (stefan_boltzmann * (2.0 * power4(t) - power4(300.0)) - 350.0);
        (loss < 500.0 ? low : high) = t;
    }
    const PointResult result = run_column(job);
    const PointRow& row = result.row.back();
    CHECK(result.has_back);
    CHECK(row.surface_temperature == Approx(low).margin(0.01));
    CHECK(row.surface_temperature - row.back_temperature ==
          Approx(-row.conducted / 50000.0).margin(1e-5));
    CHECK(row.back_temperature < row.surface_temperature);
    CHECK(result.worst_energy_closure < 1e-10);
    CHECK(result.periodic_residual < 1e-6);
}

TEST_CASE("a thin wall follows its room's and its heater's schedule",
          "[thermal][column_tool][interior]") {
    // No mass to speak of: h_out (T − T_a) = (T_room − T) / (1/8 + 0.05/0.1) + q.
    PointJob job = facet_over({{0.05, 0.1, 10.0, 100.0}}, FixedFlux{0.0}, 12.0, 0.0);
    job.site.longitude_deg = 90.0;  // the sun's clock is another
    job.utc_offset = 7200.0;        // that of schedules is two hours ahead of UTC
    job.step = 1800.0;
    job.surface.bottom =
        Interior{.air_temperature = 300.0, .film = 8.0, .schedule = {{6.0, 288.0}, {10.0, 296.0}}};
    job.surface.internal_schedule = {{0.0, 0.0}, {12.0, 60.0}, {24.0, 0.0}};
    drive(
        job, [](double) { return 0.0; }, [](double) { return 280.0; }, 0.0);
    const PointResult result = run_column(job);
    for (std::size_t i = 0; i < 48; ++i) {
        const double hour = std::fmod(0.5 * double(i) + 2.0, 24.0);
        const double later_hour = hour < 6.0 ? hour + 24.0 : hour;
        const double room = later_hour < 10.0 ? 288.0 + 2.0 * (later_hour - 6.0)
                                              : 296.0 - 8.0 * (later_hour - 10.0) / 20.0;
        const double heat = 5.0 * (hour < 12.0 ? hour : 24.0 - hour);
        const double u = 1.0 / (1.0 / 8.0 + 0.05 / 0.1);
        CAPTURE(hour);
        CHECK(result.row[i].surface_temperature ==
              Approx((12.0 * 280.0 + u * room + heat) / (12.0 + u)).margin(0.02));
    }
}

TEST_CASE("a pane takes in what it neither reflects nor lets through",
          "[thermal][column_tool][glass]") {
    // 6 mm of glass, both sides in air: 2 h (T − T_a) + ε σ (2 T⁴ − T_a⁴) − ε L = (1 − ρ − τ) S.
    PointJob job = facet_over({{0.006, 1.0, 2528.0, 880.0}}, FixedFlux{0.0}, 9.0, 0.84);
    job.surface.albedo = 0.08;
    job.surface.solar_transmittance = 0.77;
    job.surface.back = ExposedBack{.emissivity = 0.84, .albedo = 0.08};
    drive(
        job, [](double) { return 800.0; }, [](double) { return 295.0; }, 380.0);
    double low = 280.0, high = 340.0;
    for (int i = 0; i < 60; ++i) {
        const double t = 0.5 * (low + high);
        const double lost = 18.0 * (t - 295.0) +
                            0.84 * (stefan_boltzmann * (2.0 * power4(t) - power4(295.0)) - 380.0);
        (lost < 0.15 * 800.0 ? low : high) = t;
    }
    const PointRow row = run_column(job).row.back();
    CHECK(row.absorbed_solar == Approx(120.0).epsilon(1e-6));
    CHECK(0.5 * (row.surface_temperature + row.back_temperature) == Approx(low).margin(0.02));
}

TEST_CASE("a lake's mixed layer swings as a slab of closed form",
          "[thermal][column_tool][water][by_comparison]") {
    // Stirred water of 2 m over a bed without flux: |T| = |q / (h + k g tanh(g L))|, g = √(iωC/k).
    PointJob job = facet_over({{2.0, 500.0, 998.0, 4182.0}}, FixedFlux{0.0}, 15.0, 0.0);
    job.step = 900.0;
    drive(
        job, [](double t) { return 300.0 + 300.0 * std::cos(2.0 * std::numbers::pi * t / day); },
        [](double) { return 290.0; }, 0.0);
    const std::complex<double> g =
        std::sqrt(std::complex<double>(0.0, 2.0 * std::numbers::pi / day * 998.0 * 4182.0 / 500.0));
    const std::complex<double> exact = 300.0 / (15.0 + 500.0 * g * std::tanh(2.0 * g));
    const auto wave = harmonic(run_column(job));
    CHECK(std::abs(wave) == Approx(std::abs(exact)).epsilon(0.003));
    CHECK(-std::arg(wave) == Approx(-std::arg(exact)).margin(0.005));
    CHECK(std::abs(wave) < 1.0);  // dry ground swings by ten times as much
}

TEST_CASE("a column file with mistakes is answered with places, ranges and nearest keys",
          "[thermal][column_tool][errors]") {
    const auto folder = std::filesystem::temp_directory_path() / "diurna_column_tool_test";
    std::filesystem::create_directories(folder);
    const auto file = folder / "column.toml";
    std::ofstream(folder / "weather.csv")
        << "time,air_temperature_K\n2020-06-01T00:00:00Z,290\n2020-06-02T00:00:00Z,290\n";
    const std::string good = R"([site]
latitude_deg = 40.0
longitude_deg = -88.0
[material]
albedo = 0.2
emissivity = 0.97
roughness_length_m = 0.02
heat_roughness_length_m = 0.002
layers = [ { thickness_m = 0.5, conductivity_W_mK = 1.1, density_kg_m3 = 1500.0, heat_capacity_J_kgK = 1100.0 } ]
[weather]
file = "weather.csv"
interval = "instant"
[time]
start = 2020-06-01T00:00:00Z
end = 2020-06-02T00:00:00Z
)";
    std::ofstream(file) << good;
    const PointResult result = run_column(read_column_job(file));
    CHECK(result.row.size() == 49);
    const std::string csv = column_csv(result);
    CHECK(result.note.find("modelled") != std::string::npos);
    CHECK(csv.find("time,surface_temperature_K,absorbed_solar_W_m2,longwave_in_W_m2,") == 0);

    std::string bad = good;
    bad.replace(bad.find("emissivity"), 10, "emisivity ");
    bad.replace(bad.find("40.0"), 4, "99.0");
    std::ofstream(file) << bad;
    try {
        read_column_job(file);
        FAIL("accepted");
    } catch (const InputError& error) {
        const std::string what = error.what();
        INFO(what);
        CHECK(error.mistakes().size() >= 2);
        CHECK(what.find("column.toml:2:") != std::string::npos);
        CHECK(what.find("column.toml:6:") != std::string::npos);
        CHECK(what.find("emissivity") != std::string::npos);
    }
    std::filesystem::remove_all(folder);
}
