#include "materials/matter/varied.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/matter/broadband.hpp"
#include "materials/matter/library.hpp"
#include "materials/matter/read_library.hpp"

using namespace diurna;

// Means under the sun at the ground (ASTM G173) and under Planck's law are what was asked for; ρ +
// τ stays within 0 to 1, and the other half of the spectrum stays.
TEST_CASE("albedo and emissivity are varied apart", "[materials][varied]") {
    const MaterialLibrary library = default_material_library();
    const std::string name = GENERATE("grass", "asphalt", "bare_soil", "concrete", "glass");
    const Material& base = library[library.find(name)];
    const double room = 1.0 - base.thermal.solar_transmittance;
    for (const double share : {0.1, 0.4, 0.8}) {
        CAPTURE(name, share);
        const Material albedo = with_albedo(base, share * room);
        CHECK(solar_mean(albedo.reflectance) == Approx(share * room).margin(1e-9));
        CHECK(albedo.thermal.albedo == share * room);
        CHECK(albedo.thermal.emissivity == base.thermal.emissivity);

        const double emissivity = share * (1.0 - planck_mean(base.transmittance));
        const Material heat = with_emissivity(base, emissivity);
        CHECK(1.0 - planck_mean(heat.reflectance) - planck_mean(heat.transmittance) ==
              Approx(emissivity).margin(1e-9));
        CHECK(heat.thermal.emissivity == emissivity);
        CHECK(heat.thermal.albedo == base.thermal.albedo);

        for (double um = 0.35; um < 20.0; um *= 1.03) {
            CAPTURE(um);
            for (const Material* varied : {&albedo, &heat}) {
                const double rho = varied->reflectance.at(um);
                REQUIRE(rho >= -1e-12);
                REQUIRE(rho + varied->transmittance.at(um) <= 1.0 + 1e-9);
            }
            if (um > 3.5) REQUIRE(albedo.reflectance.at(um) == base.reflectance.at(um));
            if (um < 3.0) REQUIRE(heat.reflectance.at(um) == base.reflectance.at(um));
        }
    }
    const Material same = with_albedo(base, solar_mean(base.reflectance));
    for (double um = 0.35; um < 20.0; um *= 1.1) {
        CHECK(same.reflectance.at(um) == Approx(base.reflectance.at(um)).margin(1e-12));
    }
}
