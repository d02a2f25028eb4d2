#include "thermal/covered_facets.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/hills.hpp"
#include "tests/support/scratch_folder.hpp"
#include "thermal/solve/solver.hpp"
#include "thermal/temperature_field.hpp"

using namespace diurna;

namespace {

const Instant january = parse_instant("2026-01-10T00:00:00Z");
constexpr double road_albedo = 0.1, road_roughness = 0.0005;

/// A road and a black wall beside it that faces north, over the same slab.
MaterialLibrary road_and_wall() {
    std::vector<Material> all(2);
    all[0].name = "road";
    all[0].thermal.albedo = road_albedo;
    all[0].thermal.roughness_length = road_roughness;
    all[0].thermal.store.capacity_mm = 0.5;
    all[1].name = "wall";
    all[1].thermal.albedo = 0.0;
    for (Material& material : all) material.thermal.layers = {{1.0, 1.5, 2000.0, 900.0}};
    return MaterialLibrary(std::move(all));
}

/// −5 °C and a white sky; `snow` [mm] fall from 1 to 3 h.
Weather winter(double snow) {
    Weather weather;
    for (int i = 0; i <= 144; ++i) {
        Forcing f;
        f.air = {.temperature = 268.15, .pressure = 101325.0, .vapour_pressure = 380.0};
        f.wind_speed = 2.0;
        f.rain_mm_h = i >= 6 && i < 18 ? 0.5 * snow : 0.0;
        f.shortwave_down = std::max(0.0, -300.0 * std::cos(2.0 * M_PI * i / 144.0));
        f.direct_normal = 0.0;
        f.longwave_down = 250.0;
        weather.instant.push_back(later(january, 600.0 * i));
        weather.sample.push_back(f);
    }
    return weather;
}

FacetSet two_facets() {
    FacetSet facets;
    append_facets(facets,
                  std::vector<Eigen::Vector3d>{
                      {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {9, 0, 0}, {8, 0, 0}, {8, 0, 1}},
                  std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {3, 4, 5}},
                  std::vector<MaterialId>{MaterialId{0}, MaterialId{1}}, ObjectId{0});
    return facets;
}

/// The wall sees the road in the lower half of its hemisphere.
SolveResult solve_beside(double snow) {
    const FacetSet facets = two_facets();
    const bool road_first = facets.material[0] == MaterialId{0};
    REQUIRE(road_first);
    REQUIRE(facets.normal[1].z() == Approx(0.0f).margin(1e-6));
    const FacetViews views{.sky = {1.0f, 0.5f},
                           .below = {0.0f, 0.0f},
                           .others = {.row = {0, 0, 1}, .facet = {0}, .factor = {0.5f}}};
    const MaterialLibrary materials = road_and_wall();
    const SunExposure sun;
    const Weather weather = winter(snow);
    SolveOptions options{.start = january, .periodic = false};
    for (std::size_t i = 0; i <= 144; i += 6) options.heat_at.push_back(i);
    return solve({.facets = facets,
                  .views = views,
                  .sun = sun,
                  .materials = materials,
                  .weather = weather,
                  .site = {.latitude_deg = 46.5, .longitude_deg = 0.0}},
                 options);
}

}  // namespace

// 2026-11: a wall beside snowed ground got the light of dry asphalt, 69 in place of 132 W/m2.
TEST_CASE("a wall beside snowed ground gets half of what that reflects", "[thermal][snow][light]") {
    // An endless plain fills half of an upright wall's hemisphere. 10 mm are 5 cm deep at 200
    // kg/m3 and hide 0.05 / (0.05 + 5 z0) of the road (Douville et al. 1995), fresh snow's albedo
    // is 0.85 less 0.008 a day.
    const SolveResult dry = solve_beside(0.0), snowed = solve_beside(10.0);
    REQUIRE(dry.report.converged);
    REQUIRE(snowed.report.converged);
    CHECK(dry.temperature.water.empty());
    REQUIRE(snowed.temperature.water.facet == std::vector<std::uint32_t>{0});
    const double share = 0.05 / (0.05 + 5.0 * road_roughness);
    for (const std::size_t hour : {9u, 12u, 15u}) {
        CAPTURE(hour);
        const double white = 0.85 - 0.008 * (double(hour) - 2.0) / 24.0;
        const SurfaceCover& cover = snowed.temperature.water.at(hour)[0];
        CHECK(cover.snow == Approx(share).epsilon(0.01));
        CHECK(cover.snow_albedo == Approx(white).margin(0.001));
        const auto taken = [&](const SolveResult& of, std::size_t facet) {
            return double(of.heat.of(HeatTerm::absorbed_sunlight)[2 * hour + facet]);
        };
        const double global = taken(dry, 0) / (1.0 - road_albedo);
        const double albedo = road_albedo + share * (white - road_albedo);
        CHECK(taken(snowed, 0) == Approx((1.0 - albedo) * global).epsilon(0.02));
        CHECK(taken(snowed, 1) - taken(dry, 1) ==
              Approx(0.5 * (albedo - road_albedo) * global).epsilon(0.01));
    }
}

TEST_CASE("days that name other facets become one field", "[thermal][snow]") {
    CoveredFacets all;
    const std::vector<SurfaceCover> some{{0.5f, 0.0f, 0.0f}},
        more{{0.1f, 0.2f, 0.8f}, {0.3f, 0.4f, 0.7f}};
    add_row(std::vector<std::uint32_t>{7}, some, 0, all);
    add_row(std::vector<std::uint32_t>{3, 9}, more, 1, all);
    REQUIRE(all.facet == std::vector<std::uint32_t>{3, 7, 9});
    CHECK(all.at(0)[1] == some[0]);
    CHECK_FALSE(all.at(0)[0].any());
    CHECK(all.at(1)[0] == more[0]);
    CHECK(all.at(1)[2] == more[1]);
    // Snow that comes is as white as it will be, however little of it lies.
    const SurfaceCover half = between(SurfaceCover{}, more[1], 0.5);
    CHECK(half.snow == Approx(0.2));
    CHECK(half.snow_albedo == Approx(0.7));
}

TEST_CASE("what lies on facets survives the file of temperatures", "[thermal][snow]") {
    const ScratchFolder folder("covered_facets");
    const FacetSet facets = hills(4, {MaterialId{0}});
    TemperatureField field{.instant = {january, later(january, 3600.0)},
                           .facets = facets.size(),
                           .kelvin = std::vector<float>(2 * facets.size(), 270.0f)};
    save_temperature_field(folder.path / "dry.nc", field, facets, {});
    CHECK(load_temperature_field(folder.path / "dry.nc").water.empty());
    field.water = {{2, 5}, {{}, {0.25f, 0.0f, 0.0f}, {0.0f, 0.75f, 0.8125f}, {1.0f, 0.5f, 0.5f}}};
    save_temperature_field(folder.path / "wet.nc", field, facets, {});
    const TemperatureField read = load_temperature_field(folder.path / "wet.nc");
    CHECK(read.water.facet == field.water.facet);
    CHECK(read.water.cover == field.water.cover);
    const auto half_way = read.cover_at(later(january, 1800.0));
    CHECK(half_way[0].snow == Approx(0.375));
    CHECK(half_way[1].wet == Approx(0.625));
}
