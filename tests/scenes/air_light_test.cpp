#include "scenes/job/world/air_light.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "materials/air/air_by_height.hpp"
#include "materials/atmosphere/ground_fluxes.hpp"

using namespace diurna;

namespace {

BandModel air_of(const AirState& air, double visibility_km) {
    BandModel model;
    model.profile =
        profile_over(afgl_profile("MLS"), AirByHeight{.station = 200.0}, air, 200.0, 200.0);
    model.aerosol = "rural";
    model.visibility_km = visibility_km;
    model.ground_km = 0.2;
    model.cloud.base_km = 2.2;
    return model;
}

}  // namespace

TEST_CASE("light at many moments from light at few is what the air itself sends",
          "[scenes][air][light]") {
    const double visibility_km = GENERATE(23.0, 3.0);
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    // A day from a moist morning to a dry afternoon, sun from the horizon to 75 degrees.
    std::vector<AirMoment> moments;
    for (int i = 0; i < 40; ++i) {
        const double warm = unit(random);
        const AirState air{285.0 + 14.0 * warm, 99000.0, 1300.0 - 400.0 * warm * unit(random)};
        moments.push_back({air, {180.0, std::pow(unit(random), 2) * 75.0, 1.01}});
    }
    const AirLight light([&](const AirState& air) { return air_of(air, visibility_km); }, 0.2,
                         moments, {});
    for (const AirMoment& moment : moments) {
        BandModel model = air_of(moment.air, visibility_km);
        const SunLight sun{.zenith_deg = 90.0 - moment.sun.elevation_deg,
                           .distance_au = moment.sun.distance_au};
        const GroundFluxes own = ground_fluxes(model, sun, 0.2);
        const CloudlessLight found = light.at(moment);
        CAPTURE(visibility_km, moment.sun.elevation_deg, moment.air.temperature);
        const double close = moment.sun.elevation_deg < 3.0 ? 3.0 : 1.0;  // [W m⁻²]
        const double part = visibility_km > 10.0 ? 0.015 : 0.04;  // haze swells with humidity
        CHECK(found.direct_normal == Approx(own.sun_direct).epsilon(part).margin(close));
        CHECK(found.diffuse == Approx(own.sun_diffuse).epsilon(part).margin(close));
        CHECK(found.longwave == Approx(own.thermal).margin(1.0));
        model.cloud.fraction = 1.0;
        CHECK(found.longwave_overcast == Approx(ground_longwave(model, 0.2)).margin(1.0));
    }
}

TEST_CASE("no light with the sun below the horizon, and only the requested light",
          "[scenes][air][light][by_degenerate]") {
    const std::vector<AirMoment> night = {{{280.0, 1e5, 800.0}, {0.0, -5.0, 1.0}}};
    const AirLight light([](const AirState& air) { return air_of(air, 23.0); }, 0.2, night,
                         {.longwave = false});
    const CloudlessLight found = light.at(night.front());
    CHECK(found.direct_normal == 0.0);
    CHECK(found.diffuse == 0.0);
    CHECK(found.longwave == 0.0);
}
