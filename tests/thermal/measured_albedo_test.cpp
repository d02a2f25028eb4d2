#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"
#include "thermal/point/point_job_file.hpp"
#include "thermal/point/run_column.hpp"
#include "thermal/solve/solver.hpp"

// Reflected light reports the albedo of the ground below the pyranometer, and of nothing else.

using namespace diurna;

namespace {

const Instant june = parse_instant("2026-06-21T00:00:00Z");

/// A plate that only radiates; `scheduled`: stepped by itself, as those with a schedule are.
Material plate(const char* name, double albedo, bool scheduled = false) {
    Material material;
    material.name = name;
    material.thermal.albedo = albedo;
    material.thermal.emissivity = 1.0;
    material.thermal.convection = ConstantFilm{0.0};
    material.thermal.layers = {{0.01, 10.0, 1000.0, 1000.0}};
    material.thermal.bottom = FixedFlux{0.0};
    if (scheduled) material.thermal.internal_schedule = {{0.0, 0.0}};
    return material;
}

/// σT⁴ [W m⁻²] of four plates under an even sky of 300 W/m² of sunlight, day and night, of which
/// the ground below the pyranometer reflects 120, and 250 W/m² of longwave: of albedo 0.1, 0.3, 0.1
/// stepped by itself, and a black one that half sees the sky, half the first. The sun is deep down,
/// where none of that light counts as coming from round it.
std::array<double, 4> exitance(const std::vector<double>& share) {
    FacetSet facets;
    const std::vector<Eigen::Vector3d> vertex{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<std::array<std::uint32_t, 3>> triangle(4, {0, 1, 2});
    append_facets(
        facets, vertex, triangle,
        std::vector<MaterialId>{MaterialId{0}, MaterialId{1}, MaterialId{2}, MaterialId{3}},
        ObjectId{0});
    const FacetViews views{.sky = {1.0f, 1.0f, 1.0f, 0.5f},
                           .below = {0.0f, 0.0f, 0.0f, 0.0f},
                           .others = {.row = {0, 0, 0, 0, 1}, .facet = {0}, .factor = {0.5f}}};
    const MaterialLibrary materials({plate("measured", 0.1), plate("other", 0.3),
                                     plate("alone", 0.1, true), plate("black", 0.0)});
    Forcing forcing;
    forcing.air = {.temperature = 290.0, .pressure = 1e5, .vapour_pressure = 1000.0};
    forcing.shortwave_down = forcing.diffuse = 300.0;
    forcing.shortwave_up = 120.0;
    forcing.longwave_down = 250.0;
    const SunExposure sun;
    const SolveResult result = solve({.facets = facets,
                                      .views = views,
                                      .sun = sun,
                                      .materials = materials,
                                      .weather = Weather{.instant = {june}, .sample = {forcing}},
                                      .site = Site{.latitude_deg = 40.0, .longitude_deg = 180.0},
                                      .clear_sky = {.longwave_by_direction = false},
                                      .measured_share = share},
                                     {.start = june});
    CHECK(result.report.converged);
    std::array<double, 4> out{};
    for (std::size_t f = 0; f < 4; ++f) {
        out[f] = stefan_boltzmann * power4(double(result.temperature.at(12)[f]));
    }
    return out;
}

}  // namespace

TEST_CASE("measured albedo is that of one material, in what it absorbs and what it reflects",
          "[thermal][solver][albedo]") {
    // What comes in goes out: σT⁴ = (1 − α) 300 + 250; the black plate's half of what the first
    // reflects and emits besides.
    const auto expected = [](double first, double other, double alone) {
        const double emitted = (1.0 - first) * 300.0 + 250.0;
        return std::array<double, 4>{
            emitted, (1.0 - other) * 300.0 + 250.0, (1.0 - alone) * 300.0 + 250.0,
            0.5 * 300.0 + 0.5 * 250.0 + 0.5 * first * 300.0 + 0.5 * emitted};
    };
    const auto check = [](const std::array<double, 4>& found, const std::array<double, 4>& sought) {
        for (std::size_t f = 0; f < 4; ++f) {
            CAPTURE(f);
            CHECK(found[f] == Approx(sought[f]).epsilon(2e-4));
        }
    };
    check(exitance({}), expected(0.1, 0.3, 0.1));
    check(exitance({1.0, 0.0, 0.0, 0.0}), expected(0.4, 0.3, 0.1));  // 120 / 300
    check(exitance({0.0, 0.0, 1.0, 0.0}), expected(0.1, 0.3, 0.4));
    // A level of a texture that is half as bright as its material.
    check(exitance({0.5, 0.0, 0.0, 0.0}), expected(0.2, 0.3, 0.1));
    CHECK_THROWS_AS(exitance({1.0}), InputError);
}

TEST_CASE("a column's material is what its weather was measured over, unless another is named",
          "[thermal][column_tool][albedo]") {
    const ScratchFolder folder("over");
    std::string weather =
        "time,air_temperature_K,shortwave_down_W_m2,diffuse_W_m2,shortwave_up_W_m2\n";
    for (int h = 0; h <= 24; ++h) {
        weather += fmt::format("2026-06-{:02}T{:02}:00:00Z,290,500,500,120\n", 21 + h / 24, h % 24);
    }
    write_text(folder.path / "weather.csv", weather);
    const auto absorbed = [&](const std::string& key, std::string& note) {
        write_text(folder.path / "column.toml",
                   "[site]\nlatitude_deg = 40.0\nlongitude_deg = 0.0\n[material]\nname = "
                   "\"asphalt\"\nalbedo = 0.1\n[weather]\nfile = \"weather.csv\"\ninterval = "
                   "\"instant\"\n" +
                       key +
                       "[time]\nstart = 2026-06-21T00:00:00Z\nend = 2026-06-22T00:00:00Z\n"
                       "step_s = 21600.0\n");
        const PointResult result = run_column(read_column_job(folder.path / "column.toml"));
        note = result.note;
        return result.row.at(2).absorbed_solar;
    };
    std::string note;
    CHECK(absorbed("", note) == Approx(500.0 - 120.0));
    CHECK(absorbed("measured_over = \"asphalt\"\n", note) == Approx(380.0));
    CHECK(note.find("measured over") == std::string::npos);
    CHECK(absorbed("measured_over = \"grass\"\n", note) == Approx(0.9 * 500.0));
    CHECK(note.find("shortwave_up was measured over grass") != std::string::npos);
    CHECK_THROWS_WITH(absorbed("measured_over = \"gras\"\n", note),
                      Catch::Contains("did you mean 'grass'?"));
}
