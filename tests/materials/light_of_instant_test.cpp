#include "materials/atmosphere/light_of_instant.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "materials/atmosphere/sun_field.hpp"
#include "materials/base/units.hpp"

using namespace diurna;

namespace {

constexpr double ground_km = 0.3;
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

BandModel air(const std::string& profile, double visibility_km, double cover) {
    BandModel model{.profile = afgl_profile(profile),
                    .aerosol = "rural",
                    .visibility_km = visibility_km,
                    .ground_km = ground_km};
    model.cloud.fraction = cover;
    model.cloud.base_km = ground_km + 1.5;
    return model;
}

void check_sums(const LightOfInstant& light, const SunLight& sun, const KnownLight& known) {
    const GroundFluxes found = ground_fluxes(light.air, sun, ground_km);
    CHECK(found.sun_direct == Approx(known.direct_normal).epsilon(1e-3).margin(0.01));
    CHECK(found.sun_diffuse == Approx(known.diffuse).epsilon(1e-3).margin(0.01));
    CHECK(found.thermal == Approx(known.longwave_down).margin(0.1));
    CHECK(light.sums.sun_direct == Approx(found.sun_direct).epsilon(1e-9).margin(1e-9));
    CHECK(light.sums.sun_diffuse == Approx(found.sun_diffuse).epsilon(1e-9).margin(1e-9));
    CHECK(light.sums.thermal == Approx(found.thermal).epsilon(1e-9));
}

}  // namespace

TEST_CASE("an air made to have measured beam, diffuse and longwave has these sums",
          "[materials][light]") {
    // By weather: clearer than the haze says, hazier, thin cloud, broken cloud brighter than any
    // clear sky, overcast; longwave from far below the clear sky's to above its air's black body.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 12; ++i) {
        const SunLight sun{.zenith_deg = 85.0 * unit(random)};
        const double cosine = std::cos(radians(sun.zenith_deg));
        const double visibility_km = 2.0 + 80.0 * unit(random);
        const KnownLight known{.direct_normal = i % 4 == 0 ? 0.0 : 950.0 * cosine * unit(random),
                               .diffuse = 20.0 + 400.0 * cosine * unit(random),
                               .longwave_down = 180.0 + 260.0 * unit(random)};
        const BandModel model =
            air(i % 2 == 0 ? "MLS" : "US76", visibility_km, i % 3 == 0 ? 0.0 : unit(random));
        CAPTURE(i, sun.zenith_deg, visibility_km, known.direct_normal, known.diffuse,
                known.longwave_down, model.cloud.fraction);
        check_sums(light_of_instant(model, sun, ground_km, known), sun, known);
    }
}

TEST_CASE("longwave measured under a cloud that nobody reported gives that cloud's sky",
          "[materials][light]") {
    const double cover = GENERATE(0.2, 0.5, 1.0);
    const BandModel seen = air("MLS", 23.0, cover);
    const double longwave = ground_longwave(seen, ground_km);
    const LightOfInstant light =
        light_of_instant(air("MLS", 23.0, 0.0), {}, ground_km, {not_known, not_known, longwave});
    CHECK(light.cloud_cover == Approx(cover).margin(2e-3));
    const std::vector<double> um = {3.9, 8.3, 9.6, 10.5, 12.0, 14.9};
    for (const double zenith_deg : {0.0, 60.0, 85.0}) {
        const auto expected = sky_at_nodes(seen, ground_km, zenith_deg, um);
        const auto found = sky_at_nodes(light.air, ground_km, zenith_deg, um);
        for (std::size_t n = 0; n < um.size(); ++n) {
            CAPTURE(cover, zenith_deg, um[n]);
            CHECK(found[n] == Approx(expected[n]).epsilon(3e-3));
        }
    }
}

TEST_CASE("a colder sky than the air's is colder in its windows, not where the air is opaque",
          "[materials][light]") {
    const BandModel model = air("MLS", 23.0, 0.0);
    const double own = ground_longwave(model, ground_km);
    const LightOfInstant light =
        light_of_instant(model, {}, ground_km, {not_known, not_known, own - 20.0});
    const std::vector<double> um = {10.5, 14.9};
    const auto before = sky_at_nodes(model, ground_km, 30.0, um);
    const auto after = sky_at_nodes(light.air, ground_km, 30.0, um);
    CHECK(after[0] < 0.85 * before[0]);
    CHECK(after[1] == Approx(before[1]).epsilon(0.01));
}

TEST_CASE("air that has the known sums already is left as it is", "[materials][light]") {
    const BandModel model = air("US76", 23.0, 0.0);
    const SunLight sun{.zenith_deg = 40.0};
    const GroundFluxes own = ground_fluxes(model, sun, ground_km);
    const LightOfInstant light =
        light_of_instant(model, sun, ground_km, {own.sun_direct, own.sun_diffuse, own.thermal});
    const LightScale& scale = std::get<BandModel>(light.air).scale;
    CHECK(scale.beam == Approx(1.0));
    CHECK(scale.diffuse == Approx(1.0));
    CHECK(scale.sky_column == 1.0);
    CHECK(light.cloud_cover == 0.0);
}

TEST_CASE("no sun and no light are no numbers to divide by", "[materials][light][stress]") {
    for (const double zenith_deg : {89.99, 91.0, 180.0}) {
        const LightOfInstant light = light_of_instant(
            air("MLS", 0.2, 0.3), {.zenith_deg = zenith_deg}, ground_km, {30.0, 20.0, 0.0});
        CHECK(std::isfinite(light.sums.sun_direct));
        CHECK(std::isfinite(light.sums.sun_diffuse));
        CHECK(std::isfinite(light.sums.thermal));
    }
}

TEST_CASE("an overcast sends back, passes and absorbs what comes in", "[materials][light][cloud]") {
    // At 0.45 to 0.48 µm drops and ozone absorb a few per cent at most: what goes up at the top and
    // what black ground keeps are the rest.
    const std::vector<double> node_um = {0.45, 0.48};
    const SunLight sun{.zenith_deg = 35.0, .ground_albedo = 0.0};
    const double top = 1361.0 * std::cos(radians(35.0));
    for (const double diffuse : {120.0, 250.0, 500.0}) {
        const KnownLight known{0.0, diffuse, 390.0};
        BandModel model = air("MLS", 23.0, 1.0);
        model.aerosol = "none";
        const LightOfInstant light = light_of_instant(model, sun, ground_km, known);
        const SunField field(std::get<BandModel>(light.air), sun, node_um);
        const SunFlux high = field.flux(60.0), low = field.flux(ground_km);
        for (std::size_t n = 0; n < node_um.size(); ++n) {
            const double in = high.direct[n] * std::cos(radians(35.0));
            const double back = high.up[n] / in, passed = low.down[n] / in;
            CAPTURE(diffuse, node_um[n], back, passed);
            CHECK(back + passed < 1.02);
            CHECK(back + passed > 0.93);
            // Less passes in the mean of all wavelengths, where vapour absorbs.
            CHECK(passed > diffuse / top);
        }
    }
}
