#include "materials/matter/covered_material.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/matter/broadband.hpp"
#include "materials/matter/directional_optics.hpp"
#include "materials/matter/library.hpp"
#include "materials/matter/read_library.hpp"
#include "materials/matter/snow_reflectance.hpp"
#include "materials/matter/wet_reflectance.hpp"

using namespace diurna;

namespace {

const MaterialLibrary& materials() {
    static const MaterialLibrary all = default_material_library();
    return all;
}
const Material& named(const char* name) { return materials()[materials().find(name)]; }

/// Ångström's ways through the film, added up: face, then in, and out after each inner reflection.
double by_ways(double dry, double index) {
    const double face = std::pow((index - 1.0) / (index + 1.0), 2);
    const double kept_in = 1.0 - (1.0 - 0.066) / (index * index);
    double sent = face, within = 1.0 - face;
    for (int bounce = 0; bounce < 400; ++bounce) {
        within *= dry;
        sent += within * (1.0 - kept_in);
        within *= kept_in;
    }
    return sent;
}

}  // namespace

TEST_CASE("snow of an albedo has that mean under the sun", "[materials][snow]") {
    for (const double albedo : {0.3, 0.5, 0.68, 0.72, 0.8, 0.84, 0.85, 0.9}) {
        CAPTURE(albedo);
        const Spectrum snow = snow_reflectance(albedo);
        CHECK(solar_mean(snow) == Approx(albedo).margin(1e-6));
        for (const double rho : snow.value) REQUIRE((rho >= 0.0 && rho <= 1.0));
    }
    // The library's own are met where their albedo is (Wiscombe & Warren 1980 by grain size).
    for (const char* name : {"snow_fine", "snow_medium", "snow_coarse"}) {
        const Spectrum& own = named(name).reflectance;
        const Spectrum snow = snow_reflectance(solar_mean(own));
        for (std::size_t i = 0; i < own.value.size(); ++i) {
            if (own.wavelength_um[i] < 0.3 || own.wavelength_um[i] > 20.0) continue;
            CHECK(snow.at(own.wavelength_um[i]) == Approx(own.value[i]).margin(1e-9));
        }
    }
}

TEST_CASE("a covered material is the sum of its parts", "[materials][snow]") {
    const Material& asphalt = named("asphalt");
    const double share = 0.7, white = 0.8;
    const Material covered = covered_material(asphalt, {.snow = share, .snow_albedo = white});
    // Broadband: what the heat balance has, to 1 %.
    CHECK(solar_mean(covered.reflectance) ==
          Approx((1.0 - share) * asphalt.thermal.albedo + share * white).epsilon(0.01));
    const Spectrum snow = snow_reflectance(white);
    for (const double um : {0.55, 1.03, 1.65, 4.0, 10.0}) {
        const double sum = (1.0 - share) * asphalt.reflectance.at(um) + share * snow.at(um);
        CHECK(covered.reflectance.at(um) == Approx(sum).margin(1e-12));
        CHECK(directional_optics(covered, um, 0.6).emissivity == Approx(1.0 - sum).margin(1e-12));
    }
    const Material under = covered_material(asphalt, {.snow = 1.0, .snow_albedo = white});
    CHECK(under.reflectance.at(10.0) == Approx(snow.at(10.0)).margin(1e-12));
}

TEST_CASE("snow dulls gloss, opens no window and keeps energy", "[materials][snow][by_trace]") {
    for (const char* name : {"green_paint", "galvanised_steel_bright", "glass", "solar_panel"}) {
        const Material& dry = named(name);
        const double share = 0.4, um = 0.6, white = 0.83;
        const Material covered = covered_material(dry, {.snow = share, .snow_albedo = white});
        CAPTURE(name);
        for (const double cosine : {0.1, 0.5, 1.0}) {
            const DirectionalOptics open = directional_optics(dry, um, cosine);
            const DirectionalOptics both = directional_optics(covered, um, cosine);
            CHECK(both.mirrored == Approx((1.0 - share) * open.mirrored).margin(1e-12));
            CHECK(both.transmittance == Approx((1.0 - share) * open.transmittance).margin(1e-12));
            CHECK(both.diffuse ==
                  Approx((1.0 - share) * open.diffuse + share * snow_reflectance(white).at(um))
                      .margin(1e-12));
            CHECK(both.emissivity + both.mirrored + both.diffuse + both.transmittance ==
                  Approx(1.0).margin(1e-12));
        }
    }
}

TEST_CASE("wet things are darker by what a film keeps in", "[materials][wet]") {
    // Angstrom 1925; Lekner & Dorf 1988: light scattered below a film leaves it or is kept in by
    // its underside, again and again. Black shows the face of water, white stays white.
    for (const double dry : {0.0, 0.05, 0.2, 0.5, 0.9}) {
        CHECK(wet_reflectance(dry, 1.33) == Approx(by_ways(dry, 1.33)).margin(1e-9));
    }
    CHECK(wet_reflectance(0.0, 4.0 / 3.0) == Approx(1.0 / 49.0));
    CHECK(wet_reflectance(1.0, 1.33) == Approx(1.0));
    // The loam, the sand and the clay of the library after rain.
    for (const auto& [dry, wet] : {std::pair{"bare_soil", "wet_soil"},
                                   {"sandy_soil", "sandy_soil_wet"},
                                   {"clay_soil", "clay_soil_wet"}}) {
        CAPTURE(dry);
        const Spectrum found = wet_reflectance(named(dry).reflectance);
        CHECK(solar_mean(found) == Approx(solar_mean(named(wet).reflectance)).margin(0.002));
        // Their files have 40 points: 0.003 of emissivity are between these.
        CHECK(planck_mean(found) == Approx(planck_mean(named(wet).reflectance)).margin(0.004));
    }
    // Without a wet_albedo the balance knows no difference, and nor does the picture.
    Material brick = named("brick");
    brick.thermal.store.wet_albedo = -1.0;
    CHECK(covered_material(brick, {.wet = 1.0}).reflectance.value == brick.reflectance.value);
    brick.thermal.store.wet_albedo = 0.15;
    const Material half = covered_material(brick, {.wet = 0.5});
    CHECK(solar_mean(half.reflectance) ==
          Approx(0.5 * (brick.thermal.albedo + 0.15)).epsilon(0.01));
}
