#include "thermal/point/calibrate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <string>

#include "materials/base/error.hpp"
#include "tests/support/measured_days.hpp"
#include "tests/support/shared_data.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

// Numbers of a column found from curves.

namespace {

const Instant start = parse_instant("2020-06-01T00:00:00Z");
constexpr double day = 86400.0, film = 10.0, mean = 300.0, swing = 250.0;

/// A half-space under 300 + 250 cos(2 pi t / day) W/m2 and a film to air of 290 K; nothing else.
void lay_half_space(const ScratchFolder& folder, const std::string& sought) {
    std::string weather =
        "time,air_temperature_K,wind_speed_m_s,shortwave_down_W_m2,longwave_down_W_m2\n";
    for (double t = 0.0; t <= day; t += 600.0) {
        weather += fmt::format("{},290,2,{:.6f},0\n", format_instant(later(start, t)),
                               mean + swing * std::cos(2.0 * std::numbers::pi * t / day));
    }
    write_text(folder.path / "weather.csv", weather);
    write_text(folder.path / "column.toml", R"([site]
latitude_deg = 40.0
longitude_deg = 0.0
[material]
albedo = 0.0
emissivity = 0.0
roughness_length_m = 0.01
layers = [{ thickness_m = 4.0, conductivity_W_mK = 0.5, density_kg_m3 = 2000.0, heat_capacity_J_kgK = 1000.0 }]
convection = { kind = "constant", value_W_m2K = 20.0 }
bottom = { kind = "flux", value_W_m2 = 0.0 }
[weather]
file = "weather.csv"
interval = "instant"
[time]
start = 2020-06-01T00:00:00Z
end = 2020-06-02T00:00:00Z
step_s = 600.0
spin_up = "periodic"
[calibrate]
measured = "measured.csv"
sought = [
)" + sought + "]\n");
}

/// Carslaw & Jaeger 2.6: T = T_air + q0 / h + Re q1 exp(i w t - z sqrt(i w C / k)) / (h + sqrt(i w
/// k C)).
double exact(double t, double conductivity, double h, double depth = 0.0) {
    const double omega = 2.0 * std::numbers::pi / day;
    const std::complex<double> i(0.0, 1.0);
    const std::complex<double> wave =
        swing * std::exp(i * omega * t - depth * std::sqrt(i * omega * 2.0e6 / conductivity)) /
        (h + std::sqrt(i * omega * conductivity * 2.0e6));
    return 290.0 + mean / h + wave.real();
}

void lay_curve(const ScratchFolder& folder, double conductivity, double noise, double depth = 0.0) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal(0.0, 1.0);
    std::string curve = "time,skin\n";
    for (double t = 300.0; t < day; t += 1700.0) {
        curve += fmt::format("{},{:.5f}\n", format_instant(later(start, t)),
                             exact(t, conductivity, film, depth) + noise * normal(random) - 273.15);
    }
    curve += "2020-06-01T23:59:59Z,\n2020-06-05T00:00:00Z,20\n";
    write_text(folder.path / "measured.csv", curve);
}

const std::string both =
    "{ key = \"material.layers.0.conductivity_W_mK\", low = 0.2, high = 4.0, start = 0.5 },\n"
    "{ key = \"material.convection.value_W_m2K\", low = 2.0, high = 40.0 },\n";

}  // namespace

TEST_CASE("a half-space's conductivity and film are found from its closed form",
          "[thermal][column_tool][calibrate][by_comparison]") {
    const ScratchFolder folder("calibrate");
    lay_half_space(folder, both);
    lay_curve(folder, 1.3, 0.0);
    const CalibrationReport report =
        calibrate(folder.path / "column.toml", {"calibrate.unit=degC"}, false);
    CHECK(report.fit.converged);
    CHECK(report.heat_converged);
    CHECK(report.measured.size() == 51);
    CHECK(report.missing == 1);
    CHECK(report.beyond == 1);
    CHECK(report.fit.number[0].value == Approx(1.3).epsilon(0.01));
    CHECK(report.fit.number[1].value == Approx(film).epsilon(0.001));
    CHECK(report.fit.rms_before > 5.0);
    CHECK(report.fit.rms < 0.05);  // straight lines between rows, steps of the column
}

TEST_CASE("a thermometer below the surface determines both as well",
          "[thermal][column_tool][calibrate][by_comparison]") {
    const ScratchFolder folder("calibrate_depth");
    const double deep = GENERATE(0.02, 0.1, 0.25);  // 0.15, 0.75, 1.9 of the daily wave's depth
    CAPTURE(deep);
    lay_half_space(folder, both);
    lay_curve(folder, 1.3, 0.0, deep);
    const std::string at = fmt::format("calibrate.depth_m={}", deep);
    const CalibrationReport report =
        calibrate(folder.path / "column.toml", {"calibrate.unit=degC", at}, false);
    CHECK(report.fit.converged);
    CHECK(report.fit.number[0].value == Approx(1.3).epsilon(0.01));
    CHECK(report.fit.number[1].value == Approx(film).epsilon(0.002));
    CHECK(report.fit.rms < 0.05);
}

TEST_CASE("noise of a curve is in the interval", "[thermal][column_tool][calibrate]") {
    const ScratchFolder folder("calibrate_noise");
    lay_half_space(folder, both);
    lay_curve(folder, 1.3, 0.5);
    const CalibrationReport report =
        calibrate(folder.path / "column.toml", {"calibrate.unit=degC"}, false);
    const FittedNumber& found = report.fit.number[0];
    CHECK(found.least < 1.3);
    CHECK(found.most > 1.3);
    CHECK(found.most - found.least < 0.4);
    CHECK(report.fit.rms == Approx(0.5).epsilon(0.25));
}

TEST_CASE("what cannot be calibrated is refused in a line", "[thermal][column_tool][calibrate]") {
    const ScratchFolder folder("calibrate_told");
    const auto file = folder.path / "column.toml";
    const auto reported = [&](const std::string& sought, const std::vector<std::string>& settings) {
        lay_half_space(folder, sought);
        try {
            calibrate(file, settings, false);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    lay_curve(folder, 1.3, 0.0);
    using Catch::Contains;
    CHECK_THAT(reported(both, {}), Contains("measured.csv:54:2: found 20 (which is 20 K)") &&
                                       Contains("calibrate.unit"));
    const std::vector<std::string> celsius{"calibrate.unit=degC"};
    CHECK_THAT(reported("{ key = \"facet.aspect_deg\", low = 0.0, high = 90.0 },\n", celsius),
               Contains("\"facet.aspect_deg\" has no effect"));
    CHECK_THAT(reported("{ key = \"material.albdo\", low = 0.0, high = 0.5 },\n", celsius),
               Contains("albdo"));
    CHECK_THAT(reported("{ key = \"material.albedo\", low = 0.1, high = 1.5 },\n", celsius),
               Contains("material.albedo = 1.5"));
    CHECK_THAT(reported("{ key = \"material.albedo\", low = 0.5, high = 0.1 },\n", celsius),
               Contains("expected above low"));
    CHECK_THAT(reported("", celsius), Contains("one to four"));
    CHECK_THAT(reported(both, {"calibrate.unit=degC", "calibrate.of=back"}),
               Contains("no exposed back"));
    CHECK_THAT(reported(both, {"calibrate.unit=degC", "calibrate.column=skn"}), Contains("skin"));
    CHECK_THAT(reported(both, {"calibrate.unit=degC", "calibrate.depth_m=5"}),
               Contains("depth_m = 5, but the column's deepest node is at 4 m"));
    CHECK_THAT(
        reported(both, {"calibrate.unit=degC", "calibrate.of=surface", "calibrate.depth_m=1"}),
        Contains("has no effect with of"));
    CHECK_THAT(reported(both, {"calibrate.unit=degC", "time.end=2020-06-01T00:50:00Z"}),
               Contains("2 values"));
}

// Bare cinders of Woodhouse Mesa, September 2022 (Koeppel et al. 2024): the skin's temperature by
// the minute, which the library's basalt_cinder meets to 1.5 K rms.
TEST_CASE("measured cinders have the inertia and albedo of dark, loose ground",
          "[thermal][column_tool][calibrate][by_history]") {
    const auto data = shared_data("data/thermal/woodhouse_mesa_2022");
    if (!data) return;
    const ScratchFolder folder("calibrate_cinders");
    const auto rows = measured::rows_of(*data / "wh2022_days1-2.csv", 1, ',');
    const Instant first = parse_instant("2022-09-15T16:58:00-07:00");
    std::string weather =
        "time,air_temperature_K,relative_humidity,pressure_Pa,wind_speed_m_s,shortwave_down_W_m2,"
        "shortwave_up_W_m2,longwave_down_W_m2,diffuse_W_m2\n";
    std::string curve = "time,skin\n";
    for (const auto& r : rows) {
        const std::string when = format_instant(later(first, 60.0 * r[0]));
        const double sun = std::max(0.0, r[5]);
        weather += fmt::format("{},{:.2f},{:.4f},{:.1f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}\n", when,
                               r[1] + 273.15, r[2], r[3], r[4], sun, std::max(0.0, r[6]), r[7],
                               std::clamp(r[8], 0.0, 1.0) * sun);
        if (r[12] == 1.0) curve += fmt::format("{},{:.4f}\n", when, r[11]);
    }
    write_text(folder.path / "weather.csv", weather);
    write_text(folder.path / "measured.csv", curve);
    std::string profile;
    const double depth[]{0.0, 0.05, 0.10, 0.20, 0.30, 0.40, 0.50};
    for (std::size_t i = 0; i < 7; ++i) {
        profile += fmt::format("[{}, {:.2f}], ", depth[i], rows.front()[13 + i] + 273.15);
    }
    write_text(folder.path / "column.toml", R"([site]
latitude_deg = 35.4
longitude_deg = -111.3
elevation_m = 1600.0
[material]
name = "cinders"
albedo = 0.0414
emissivity = 0.966
roughness_length_m = 0.01
layers = [{ thickness_m = 1.2, conductivity_W_mK = 0.17, density_kg_m3 = 1487.0, heat_capacity_J_kgK = 800.0 }]
bottom = { kind = "temperature", value_K = 299.28 }
[weather]
file = "weather.csv"
interval = "instant"
wind_height_m = 3.0
[time]
start = 2022-09-15T23:58:00Z
end = 2022-09-17T22:30:00Z
step_s = 600.0
spin_up = "none"
initial_profile = [)" + profile + R"(]
[calibrate]
measured = "measured.csv"
unit = "degC"
sought = [
    { key = "material.layers.0.conductivity_W_mK", low = 0.05, high = 1.0, start = 0.17 },
    { key = "material.roughness_length_m", low = 0.0005, high = 0.1 },
]
)");
    const CalibrationReport report = calibrate(folder.path / "column.toml", {}, false);
    const Fit& fit = report.fit;
    WARN(
        fmt::format("cinders: rms {:.2f} to {:.2f} K, k {:.3f} ({:.3f} to {:.3f}) W/mK, z0 {:.4f} "
                    "({:.4f} to {:.4f}) m, correlation {:+.2f}, residuals alike {:.3f}, {} columns",
                    fit.rms_before, fit.rms, fit.number[0].value, fit.number[0].least,
                    fit.number[0].most, fit.number[1].value, fit.number[1].least,
                    fit.number[1].most, fit.correlation[0][1], fit.alike, fit.runs));
    CHECK(fit.converged);
    CHECK(fit.rms < fit.rms_before);
    CHECK(fit.rms < 2.0);
    // Inertia of loose, dark cinders: 300 to 600 J m-2 K-1 s-1/2 (the authors' first guess, 0.17
    // W/mK dry, makes 450).
    const double inertia = std::sqrt(fit.number[0].value * 1487.0 * 800.0);
    CHECK(inertia > 300.0);
    CHECK(inertia < 600.0);
}
