#include "materials/matter/waves.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/units.hpp"
#include "materials/matter/broadband.hpp"
#include "materials/matter/directional_optics.hpp"
#include "materials/matter/read_library.hpp"
#include "tests/support/sea.hpp"

using namespace diurna;

namespace {

const Material& water() {
    static const MaterialLibrary library = default_material_library();
    return library[library.find("water")];
}

}  // namespace

// Cox & Munk 1954, table 1 and their fit: 0.0289 ± 0.004 at 5 m/s, 0.054 at 10 m/s.
TEST_CASE("water is as rough as Cox and Munk saw it", "[materials][waves][by_history]") {
    CHECK(mean_square_slope(5.0) == Approx(0.0286).epsilon(0.01));
    CHECK(mean_square_slope(10.0) == Approx(0.0542).epsilon(0.01));
    CHECK(wind_over_water(5.0, 12.5) == Approx(5.0));
    // ln(12.5 / 0.0002) / ln(2 / 0.0002)
    CHECK(wind_over_water(5.0, 2.0) == Approx(5.0 * 11.043 / 9.210).epsilon(1e-3));
}

// ((n − 1)² + k²) / ((n + 1)² + k²) with Hale & Querry's indices; 2.0 % of visible light, 0.7 % at
// 11 µm, 2.4 % at 3.7 µm.
TEST_CASE("water reflects at the normal what its index says", "[materials][waves]") {
    struct Row {
        double um, reflectance;
    };
    for (const auto& [um, reflectance] :
         {Row{0.55, 0.02037}, Row{1.0, 0.01975}, Row{3.7, 0.02482}, Row{10.0, 0.01019},
          Row{11.0, 0.00706}, Row{12.0, 0.01156}}) {
        CAPTURE(um);
        CHECK(interface_reflectance(water().finish, um, 1.0) == Approx(reflectance).epsilon(0.01));
    }
}

TEST_CASE("water's emissivity by angle is the sum over its waves",
          "[materials][waves][by_comparison]") {
    const double wind = GENERATE(1.0, 3.0, 5.0, 10.0, 15.0);
    const Material material = under_wind(water(), wind);
    const Sea sea{wind};
    for (const double um : {8.6, 10.0, 11.0, 12.0}) {
        for (const double angle : {0.0, 30.0, 50.0, 60.0, 70.0, 75.0, 80.0, 85.0, 88.0}) {
            const double cosine = std::cos(radians(angle));
            const double emissivity = directional_optics(material, um, cosine).emissivity;
            CAPTURE(wind, um, angle, emissivity, sea.emissivity(cosine, um));
            CHECK(emissivity == Approx(sea.emissivity(cosine, um)).margin(2.5e-3));
        }
    }
}

TEST_CASE("no wind and no angle takes water's emissivity out of 0 to 1", "[materials][waves]") {
    for (const double wind : {0.0, 0.5, 2.0, 8.0, 30.0}) {
        const Material material = under_wind(water(), wind);
        for (const double um : {0.4, 1.6, 2.9, 4.0, 11.0, 15.0}) {
            for (const double angle : {0.0, 60.0, 80.0, 87.0, 89.0, 89.9, 90.0}) {
                const auto optics = directional_optics(material, um, std::cos(radians(angle)));
                CAPTURE(wind, um, angle, optics.emissivity);
                CHECK(optics.emissivity > 0.0);
                CHECK(optics.emissivity < 1.0);
                CHECK(optics.emissivity + optics.mirrored + optics.diffuse == Approx(1.0));
            }
        }
    }
}

// What the heat balance takes is ∫ ε(θ) 2 cosθ d cosθ, here by 100 midpoints, under Planck's law.
TEST_CASE("water's heat balance has the mean of the emissivity by angle", "[materials][waves]") {
    const std::vector<double>& um = water().reflectance.wavelength_um;
    Spectrum mean{.wavelength_um = um, .value = std::vector<double>(um.size(), 0.0)};
    constexpr int steps = 100;
    for (std::size_t n = 0; n < um.size(); ++n) {
        if (um[n] < 2.0) continue;
        for (int i = 0; i < steps; ++i) {
            const double cosine = (i + 0.5) / steps;
            mean.value[n] +=
                directional_optics(water(), um[n], cosine).emissivity * 2.0 * cosine / steps;
        }
    }
    CHECK(water().thermal.emissivity == Approx(planck_mean(mean)).margin(1e-3));
    // Winds of half to ten metres a second change it little.
    for (const double wind : {0.5, 10.0}) {
        const auto optics = hemispherical_optics(under_wind(water(), wind), 10.0);
        CAPTURE(wind, optics.emissivity);
        CHECK(optics.emissivity ==
              Approx(hemispherical_optics(water(), 10.0).emissivity).margin(8e-3));
    }
}

// Payne 1972, J. Atmos. Sci. 29, 959: the sea's albedo under overcast is 0.061 ± 0.005. Oke 1987,
// Boundary Layer Climates, table 1.1: emissivity of water 0.92 to 0.97, rounded.
TEST_CASE("water's broadband means are the measured ones", "[materials][waves][by_history]") {
    CAPTURE(water().thermal.albedo, water().thermal.emissivity);
    CHECK(water().thermal.albedo == Approx(0.061).margin(0.005));
    CHECK(water().thermal.emissivity > 0.915);
    CHECK(water().thermal.emissivity < 0.97);
}
