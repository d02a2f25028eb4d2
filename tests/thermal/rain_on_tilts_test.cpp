#include <catch2/catch.hpp>
#include <cmath>

#include "materials/air/moist_air.hpp"
#include "materials/base/units.hpp"
#include "tests/support/column_jobs.hpp"
#include "thermal/surface/standing_water.hpp"

// What falls on a facet of the point tool, and what a pane under snow absorbs.

using namespace diurna;
using namespace column_jobs;

namespace {

/// A day under rain of so many mm/h in air of some temperature.
PointJob under_rain(double mm_h, double air) {
    PointJob job = facet_over({deep}, FixedFlux{0.0}, 10.0, 0.0);
    job.spin_up = SpinUp::none;
    job.initial_temperature = air;
    job.surface.store = {.capacity_mm = 100.0, .leaves = true};
    drive(
        job, [](double) { return 0.0; }, [&](double) { return air; }, 300.0);
    for (Forcing& f : job.weather.sample) {
        f.rain_mm_h = mm_h;
        f.direct_normal = 0.0;
    }
    return job;
}

}  // namespace

// Of drops that fall straight down a plane of slope s meets cos(s) for each square metre of it.
TEST_CASE("rain falls on a tilted facet by the cosine of its slope",
          "[thermal][column_tool][rain]") {
    for (const double slope : {0.0, 30.0, 60.0, 89.9, 90.0, 120.0, 180.0}) {
        PointJob job = under_rain(1.0, 285.0);
        job.slope_deg = slope;
        job.sky_view = 0.5 * (1.0 + std::cos(radians(slope)));
        CAPTURE(slope);
        CHECK(run_column(job).water.fallen ==
              Approx(24.0 * std::max(0.0, std::cos(radians(slope)))).margin(1e-6));
    }
    // Ground that hides the sky at the sides is no roof.
    PointJob valley = under_rain(1.0, 285.0);
    valley.sky_view = 0.5;
    CHECK(run_column(valley).water.fallen == Approx(24.0));
}

TEST_CASE("what is in flight gathers neither rain nor snow", "[thermal][column_tool][rain]") {
    for (const double air : {285.0, 265.0}) {
        PointJob job = under_rain(1.0, air);
        job.surface.convection = BodyFilm{};
        job.surface.flight = Flight{100.0, 1.0};
        const PointResult result = run_column(job);
        CHECK(result.water.fallen == 0.0);
        CHECK(result.row.back().frost_mm < 0.01);
    }
}

// Snow that covers a share c absorbs 1 − albedo of it, the pane beside it 1 − ρ − τ: light that
// would have passed is sent back or kept by the snow above.
TEST_CASE("a pane under snow absorbs what snow does", "[thermal][column_tool][snow]") {
    constexpr double rho = 0.07, tau = 0.80, sun = 300.0;
    PointJob job = under_rain(0.0, 255.0);
    job.surface.albedo = rho;
    job.surface.solar_transmittance = tau;
    job.surface.roughness_length = 0.001;
    drive(
        job, [](double) { return sun; }, [](double) { return 255.0; }, 300.0, 600.0);
    for (std::size_t i = 0; i < job.weather.sample.size(); ++i) {
        job.weather.sample[i].rain_mm_h = i < 36 ? 1.0 : 0.0;  // six hours of snow
        job.weather.sample[i].direct_normal = 0.0;
    }
    double before = 1.0 - rho - tau;
    for (const PointRow& row : run_column(job).row) {
        const double share = snow_cover(row.frost_mm, 0.001).share;
        const double white = 1.0 - row.absorbed_solar / sun;
        CAPTURE(row.frost_mm, share, row.absorbed_solar);
        if (share == 0.0) {
            CHECK(row.absorbed_solar == Approx(sun * before));
            continue;
        }
        // Fresh at 0.85, by 0.008 a day older.
        CHECK(white == Approx(share * 0.85 + (1.0 - share) * (rho + tau)).margin(0.01));
        before = row.absorbed_solar / sun;
    }
    CHECK(before == Approx(0.15).margin(0.012));
}
