#include <catch2/catch.hpp>
#include <cmath>

#include "thermal/point/point_job.hpp"
#include "thermal/point/run_column.hpp"
#include "thermal/solve/solver.hpp"

using namespace diurna;

namespace {

const Instant start = parse_instant("2026-06-21T00:00:00Z");

/// A summer day of which every hour is measured.
Weather summer() {
    Weather weather;
    for (int i = 0; i <= 144; ++i) {
        Forcing f;
        const double phase = 2.0 * M_PI * i / 144.0;
        f.air.temperature = 292.0 - 6.0 * std::cos(phase - 0.6);
        f.air.vapour_pressure = 1100.0;
        f.wind_speed = 2.5 - 1.5 * std::cos(phase - 0.6);
        f.shortwave_down = std::max(0.0, -850.0 * std::cos(phase));
        f.longwave_down = 320.0 - 25.0 * std::cos(phase - 0.5);
        weather.instant.push_back(later(start, 600.0 * i));
        weather.sample.push_back(f);
    }
    return weather;
}

Material deep_ground(double depth) {
    Material material;
    material.name = "ground";
    material.thermal.albedo = 0.2;
    material.thermal.emissivity = 0.96;
    material.thermal.roughness_length = 0.02;
    material.thermal.heat_roughness_length = 0.002;
    // 10 m have a time constant of two years: nothing spun up for weeks comes near.
    material.thermal.layers = {{0.1, 0.6, 1500.0, 1000.0}, {depth - 0.1, 1.2, 1700.0, 1200.0}};
    return material;
}

}  // namespace

TEST_CASE("the periodic day of columns up to 10 m is found in six passes, to 0.01 K",
          "[thermal][periodic]") {
    const double depth = GENERATE(1.0, 3.0, 10.0);
    CAPTURE(depth);
    const Weather weather = summer();
    const Material material = deep_ground(depth);
    PointJob job;
    job.surface = material.thermal;
    job.weather = weather;
    job.start = start;
    job.end = later(start, 86400.0);
    job.step = 3600.0;
    job.spin_up = SpinUp::periodic;
    const PointResult point = run_column(job);
    CHECK(point.passes <= 6);
    CHECK(point.periodic_residual <= 1e-4);
    // The true error: the answer does not know where it began. Steps are chosen again, to 0.002 K.
    for (const double guess : {262.0, 322.0}) {
        PointJob other = job;
        other.initial_temperature = guess;
        const PointResult again = run_column(other);
        CHECK(again.passes <= 6);
        for (std::size_t i = 0; i < point.row.size(); ++i) {
            CHECK(again.row[i].surface_temperature ==
                  Approx(point.row[i].surface_temperature).margin(0.01));
        }
    }

    FacetSet facets;
    const std::vector<Eigen::Vector3d> vertex{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const std::vector<std::array<std::uint32_t, 3>> triangle{{0, 1, 2}};
    const std::vector<MaterialId> ids{MaterialId{0}};
    append_facets(facets, vertex, triangle, ids, ObjectId{0});
    FacetViews view;
    view.sky = {1.0f};
    view.below = {0.0f};
    view.others.row = {0, 0};
    const MaterialLibrary materials({material});
    const SunExposure sun;
    const SolveResult scene = solve({.facets = facets,
                                     .views = view,
                                     .sun = sun,
                                     .materials = materials,
                                     .weather = weather,
                                     .site = job.site},
                                    {.start = start});
    CHECK(scene.report.converged);
    CHECK(scene.report.passes <= 6);
    CHECK(scene.report.periodic_residual <= 1e-4);
    CHECK(scene.report.estimated_error <= 0.01);
    double worst = 0.0;
    for (std::size_t i = 0; i < point.row.size(); ++i) {
        worst = std::max(worst,
                         std::abs(scene.temperature.at(i)[0] - point.row[i].surface_temperature));
    }
    CAPTURE(worst);
    CHECK(worst < 0.05);
}
