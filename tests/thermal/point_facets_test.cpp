#include "thermal/solve/point_facets.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/soil.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/hills.hpp"
#include "thermal/point/point_job.hpp"
#include "thermal/point/run_column.hpp"

using namespace diurna;

namespace {

const Site valley{.latitude_deg = 46.5, .longitude_deg = 9.8, .height = 1500.0};
const Instant march_first = parse_instant("2026-03-01T00:00:00Z");

Material ground(const char* name, double albedo, std::vector<Layer> layers) {
    Material material;
    material.name = name;
    material.thermal.albedo = albedo;
    material.thermal.emissivity = 0.97;
    material.thermal.roughness_length = 0.02;
    material.thermal.heat_roughness_length = 0.002;
    material.thermal.layers = std::move(layers);
    return material;
}

enum Ground { snow, ageing_snow, big_leaf, two_source, wet, freezing, room, rock, grounds };

MaterialLibrary library() {
    Soil loam = soil_named("loam");
    loam.saturation = 0.6;
    const Layer thawed{3.0, 0.9, 1500.0, 1300.0};
    std::vector<Material> all(grounds);
    all[snow] = ground("snow", 0.75, {{0.5, 0.2, 300.0, 2090.0, Melting{}}});
    all[snow].thermal.bottom = FixedTemperature{273.15};
    all[snow].thermal.evaporation = {.minimum_resistance = 0.0, .wetness = 1.0};
    all[ageing_snow] = all[snow];
    all[ageing_snow].name = "ageing snow";
    all[ageing_snow].thermal.snow_albedo = AgeingAlbedo{};
    all[big_leaf] = ground("big leaf", 0.2, {thawed});
    all[big_leaf].thermal.canopy = BigLeaf{.skin_conductance = 10.0};
    all[big_leaf].thermal.evaporation = {.minimum_resistance = 70.0, .wetness = 1.0};
    all[two_source] = ground("two-source", 0.2, {thawed});
    all[two_source].thermal.canopy = TwoSource{.leaf_area = 1.5, .leaf_resistance = 100.0};
    all[wet] = ground("wet ground", 0.25, {thawed});
    all[wet].thermal.store = {.capacity_mm = 1.0, .wet_albedo = 0.12};
    all[freezing] = ground("freezing loam", 0.2, {soil_layer(loam, 3.0)});
    all[room] = ground("roof", 0.4, {{0.05, 0.03, 43.0, 1210.0}});
    all[room].thermal.convection = Tarp{};
    all[room].thermal.bottom =
        Interior{.air_temperature = 290.0, .film = 8.0, .schedule = {{6.0, 286.0}, {9.0, 294.0}}};
    all[room].thermal.internal_schedule = {{0.0, 0.0}, {12.0, 30.0}, {24.0, 0.0}};
    all[rock] = ground("rock", 0.25, {{4.0, 2.5, 2500.0, 800.0}});
    return MaterialLibrary(std::move(all));
}

/// A day around `mean`, clear, with a shower at noon.
Weather day(double mean) {
    Weather weather;
    for (int h = 0; h <= 24; ++h) {
        Forcing f;
        const double wave = std::cos(2.0 * M_PI * (h - 14) / 24.0);
        f.air = {.temperature = mean + 5.0 * wave, .pressure = 85000.0, .vapour_pressure = 350.0};
        f.wind_speed = 2.5 + 1.5 * wave;
        f.rain_mm_h = h == 12 ? 2.0 : 0.0;
        f.shortwave_down = std::max(0.0, -650.0 * std::cos(2.0 * M_PI * h / 24.0) - 50.0);
        f.longwave_down = 250.0 + 20.0 * wave;
        weather.instant.push_back(later(march_first, 3600.0 * h));
        weather.sample.push_back(f);
    }
    return weather;
}

/// Level facets side by side, one of each ground, under the whole sky.
FacetSet level_facets() {
    FacetSet facets;
    std::vector<Eigen::Vector3d> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;
    std::vector<MaterialId> material;
    for (std::uint32_t g = 0; g < grounds; ++g) {
        const double east = 3.0 * g;
        vertex.insert(vertex.end(), {{east, 0, 0}, {east + 1, 0, 0}, {east, 1, 0}});
        triangle.push_back({3 * g, 3 * g + 1, 3 * g + 2});
        material.push_back(MaterialId{static_cast<std::uint16_t>(g)});
    }
    append_facets(facets, vertex, triangle, material, ObjectId{0});
    return facets;
}

SolveResult solve_level(const Weather& weather, const SolveOptions& options) {
    const FacetSet facets = level_facets();
    FacetViews view;
    view.sky.assign(grounds, 1.0f);
    view.below.assign(grounds, 0.0f);
    view.others.row.assign(grounds + 1, 0);
    const SunExposure sun;
    const MaterialLibrary materials = library();
    return solve({.facets = facets,
                  .views = view,
                  .sun = sun,
                  .materials = materials,
                  .weather = weather,
                  .site = valley,
                  .elevation = 1500.0},
                 options);
}

}  // namespace

TEST_CASE("snow, leaves, standing water, freezing ground and schedules reach the scene's facets",
          "[thermal][scene_points]") {
    // The point tool takes its own, far shorter steps on a finer grid: 0.002 K each.
    const Weather weather = day(274.0);
    const SolveResult result = solve_level(weather, {.start = march_first});
    CHECK(result.report.converged);
    CHECK(result.report.points == 7);
    CHECK(result.report.limited == 0);
    CHECK(result.report.worst_energy_closure < 1e-9);
    CHECK(result.report.worst_water_closure < 1e-9);
    CHECK(result.report.batched == 4);
    const MaterialLibrary materials = library();
    for (int g = 0; g < grounds; ++g) {
        PointJob job;
        job.site = valley;
        job.elevation = 1500.0;
        job.surface = materials[MaterialId{static_cast<std::uint16_t>(g)}].thermal;
        job.weather = weather;
        job.start = march_first;
        job.end = later(march_first, 86400.0);
        job.step = 3600.0;
        job.spin_up = SpinUp::periodic;
        const PointResult point = run_column(job);
        double worst = 0.0, sum = 0.0;
        for (std::size_t h = 0; h <= 24; ++h) {
            const double e =
                result.temperature.at(h)[std::size_t(g)] - point.row[h].surface_temperature;
            worst = std::max(worst, std::abs(e));
            sum += e * e;
        }
        CAPTURE(g, point.passes, point.periodic_residual);
        CHECK(worst < 0.15);
        CHECK(std::sqrt(sum / 25.0) < 0.05);
    }
}

TEST_CASE("on hills with shadows every point closes its day and its energy",
          "[thermal][scene_points][energy][by_trace]") {
    std::vector<MaterialId> materials;
    for (std::uint16_t g = 0; g < grounds; ++g) materials.push_back(MaterialId{g});
    const FacetSet facets = hills(12, materials);
    const RayScene rays(facets);
    const FacetViews view = facet_views(facets, rays);
    const MaterialLibrary all = library();
    const Weather cold = day(274.0), warm = day(293.0);
    const auto run = [&](const Weather& weather, SolveOptions options) {
        options.start = march_first;
        const SunExposure sun = shadows(facets, rays, valley, options);
        return solve({.facets = facets,
                      .views = view,
                      .sun = sun,
                      .materials = all,
                      .weather = weather,
                      .site = valley,
                      .elevation = 1500.0},
                     options);
    };
    const SolveOptions options{.step = 1200.0};
    const SolveResult result = run(cold, options);
    const SolveReport& report = result.report;
    CAPTURE(report.passes, report.point_passes);
    CHECK(report.converged);
    CHECK(report.points > facets.size() / 2);
    CHECK(report.limited == 0);
    CHECK(report.worst_energy_closure < 1e-9);
    CHECK(report.periodic_residual <= 1e-4);
    const auto first = result.temperature.at(0), last = result.temperature.at(24);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        REQUIRE(std::abs(first[f] - last[f]) < 1e-3f);
        const bool is_snow =
            facets.material[f] == MaterialId{snow} || facets.material[f] == MaterialId{ageing_snow};
        for (std::size_t h = 0; is_snow && h <= 24; ++h) {
            REQUIRE(result.temperature.at(h)[f] <= 273.151f);
        }
    }
    // Any number of threads writes the same bytes.
    set_thread_count(1);
    const SolveResult alone = run(cold, options);
    set_thread_count(0);
    CHECK(std::memcmp(alone.temperature.kelvin.data(), result.temperature.kelvin.data(),
                      result.temperature.kelvin.size() * sizeof(float)) == 0);
    // On a warm day ground does not freeze, and plain facets cost what they cost.
    const SolveResult summer = run(warm, options);
    std::size_t always = 0;
    for (const MaterialId id : facets.material) {
        const PointNeed need = point_need(all[id].thermal);
        always += need == PointNeed::always || need == PointNeed::if_wet;  // a shower at noon
    }
    CHECK(summer.report.points == always);
    CHECK(summer.report.converged);
}

TEST_CASE("who needs to be solved as a point", "[thermal][scene_points]") {
    const MaterialLibrary all = library();
    const auto need = [&](Ground g) {
        return point_need(all[MaterialId{static_cast<std::uint16_t>(g)}].thermal);
    };
    CHECK(need(rock) == PointNeed::never);
    CHECK(need(freezing) == PointNeed::if_freezing);
    CHECK(need(wet) == PointNeed::if_wet);
    for (const Ground g : {snow, ageing_snow, big_leaf, two_source, room}) {
        CHECK(need(g) == PointNeed::always);
    }
}
