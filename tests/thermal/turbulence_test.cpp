#include "thermal/surface/turbulence.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/air/saturation.hpp"

using namespace diurna;

namespace {

ThermalSurface surface_of(Convection convection, double z0 = 0.01, double z0h = 0.001) {
    ThermalSurface surface;
    surface.roughness_length = z0;
    surface.heat_roughness_length = z0h;
    surface.convection = convection;
    return surface;
}

AirFilm louis_film(double wind, double z0 = 0.01, double z0h = 0.001) {
    const AirState dry{.temperature = 300.0, .pressure = 1e5, .vapour_pressure = 0.0};
    const Louis similarity{.least_film = 0.0, .gust = 0.0};
    return air_film(surface_of(similarity, z0, z0h), louis_form(z0, z0h, 10.0, 2.0), dry, wind);
}

}  // namespace

TEST_CASE("Louis's form gives the heat of iterated Monin-Obukhov similarity",
          "[thermal][turbulence][a13][by_comparison]") {
    // reference/thermal/analytic_cases.md, A13: Businger-Dyer iterated to convergence.
    struct Case {
        double wind, excess, heat;
    };
    const auto c = GENERATE(Case{5, 20, 496.44504}, Case{2, 20, 288.61893}, Case{3, 5, 70.456602},
                            Case{5, -3, -39.798396}, Case{8, -5, -120.53019});
    CAPTURE(c.wind, c.excess);
    const Film film = ground_film(louis_film(c.wind), 300.0 + c.excess);
    CHECK(film.h * c.excess == Approx(c.heat).epsilon(0.025));
}

TEST_CASE("the unstable fit holds for every pair of roughness lengths", "[thermal][turbulence]") {
    for (const double z0 : {0.0002, 0.001, 0.01, 0.1, 1.0}) {
        for (const double ratio : {1.0, 0.1, 0.01}) {
            CAPTURE(z0, ratio);
            CHECK(louis_form(z0, z0 * ratio, 10.0, 2.0).worst_fit < 0.06);
        }
    }
}

TEST_CASE("films and vapour change with temperature as their derivatives say",
          "[thermal][turbulence][derivative][by_variation]") {
    const double wind = GENERATE(0.0, 1.0, 8.0);
    const double temperature = GENERATE(270.0, 292.0, 299.9, 300.1, 320.0, 390.0);
    CAPTURE(wind, temperature);
    const double d = 1e-4;
    const auto sensible = [&](const auto& film, double t) { return film(t).h * (t - 300.0); };
    const auto compare = [&](const auto& film) {
        const double numeric =
            (sensible(film, temperature + d) - sensible(film, temperature - d)) / (2.0 * d);
        CHECK(film(temperature).h + film(temperature).rise == Approx(numeric).epsilon(1e-5));
    };
    const AirFilm ground = louis_film(wind);
    compare([&](double t) { return ground_film(ground, t); });
    double slope;
    const double pressure = saturation_over_water(temperature, slope);
    CHECK(pressure == Approx(saturation_vapour_pressure(temperature)).epsilon(1e-13));
    const double difference =
        saturation_vapour_pressure(temperature + d) - saturation_vapour_pressure(temperature - d);
    CHECK(slope == Approx(difference / (2.0 * d)).epsilon(1e-7));
}

TEST_CASE("the cube root is the library's", "[thermal][turbulence]") {
    double worst = 0.0;
    for (double x = 1e-290; x < 1e290; x *= 1.0137) {
        worst = std::max(worst, std::abs(cube_root(x) / std::cbrt(x) - 1.0));
    }
    for (double x = 1e-12; x < 1e4; x *= 1.00037) {
        worst = std::max(worst, std::abs(cube_root(x) / std::cbrt(x) - 1.0));
    }
    CHECK(worst < 2e-15);
    CHECK(cube_root(0.0) == 0.0);
    CHECK(cube_root(5e-324) >= 0.0);
    CHECK(cube_root(5e-324) < 1e-90);
    CHECK(std::isnan(cube_root(std::nan(""))));
}

TEST_CASE("stable air damps the film down to a Richardson number of a tenth",
          "[thermal][turbulence]") {
    // x = g z_u (T_a − T_s) / (T_a U²): 10 m at 2 m/s under 300 K reaches 0.1 with 1.2232 K. There
    // L_m = 6.9078, L_h = 7.6009, s = 5 · 0.90881 (1 + 0.2 · 0.90881) = 5.3700,
    // F = 1 / (1 + 0.53700 · 2) = 0.48216, and ρ c_p k² U / (L_m L_h) = 7.1132 W/m²K.
    const AirFilm air = louis_film(2.0);
    const double there = 7.1132 * 0.48216;
    CHECK(ground_film(air, 300.0 - 1.2232).h == Approx(there).epsilon(1e-3));
    for (const double excess : {1.3, 5.0, 20.0, 60.0}) {
        CHECK(ground_film(air, 300.0 - excess).h == Approx(there).epsilon(1e-3));
        CHECK(ground_film(air, 300.0 - excess).rise == 0.0);
    }
    CHECK(ground_film(air, 300.0 - 0.6).h > 1.2 * there);
}

TEST_CASE("gusts mix as wind does", "[thermal][turbulence]") {
    const AirState air{.temperature = 290.0, .pressure = 1e5, .vapour_pressure = 500.0};
    const LouisForm form = louis_form(0.01, 0.001, 10.0, 2.0);
    const auto film = [&](double wind, double gust) {
        return air_film(surface_of(Louis{.least_film = 0.0, .gust = gust}), form, air, wind);
    };
    CHECK(film(3.0, 4.0).neutral == Approx(film(5.0, 0.0).neutral).epsilon(1e-12));
    CHECK(film(3.0, 4.0).instability == Approx(film(5.0, 0.0).instability).epsilon(1e-12));
}

TEST_CASE("calm air over hot ground convects by itself", "[thermal][turbulence]") {
    // Free convection goes as ΔT^(4/3) to ΔT^(3/2); it must neither vanish nor blow up in a calm.
    const AirFilm calm = louis_film(0.0);
    const double h10 = ground_film(calm, 310.0).h, h40 = ground_film(calm, 340.0).h;
    CHECK(h10 > 2.0);
    CHECK(h40 < 40.0);
    CHECK(h40 / h10 == Approx(2.0).epsilon(0.1));
}

TEST_CASE("water evaporates into dry air, dews out of moist, and takes nothing when saturated",
          "[thermal][turbulence][latent]") {
    ThermalSurface wet = surface_of(ConstantFilm{12.0});
    wet.evaporation = {.minimum_resistance = 70.0, .wetness = 1.0};
    const LouisForm form = louis_form(0.01, 0.001, 10.0, 2.0);
    const double saturated = saturation_vapour_pressure(293.0);
    const auto flux = [&](double vapour, double temperature) {
        const AirState air{.temperature = 293.0, .pressure = 1e5, .vapour_pressure = vapour};
        const AirFilm film = air_film(wet, form, air, 2.0);
        return latent_heat(film, ground_film(film, temperature), temperature).flux;
    };
    CHECK(flux(saturated, 293.0) == Approx(0.0).margin(1e-9));
    CHECK(flux(0.5 * saturated, 293.0) < -10.0);
    CHECK(flux(saturated, 290.0) > 10.0);
    // ρ L 0.622/p Δe / (ρ cp/h + rs), by hand at 293 K over dry air.
    const AirState air{.temperature = 293.0, .pressure = 1e5, .vapour_pressure = 0.0};
    const double expected = -air_density(air) * latent_heat_of_vaporisation(293.0) * 0.62198 / 1e5 *
                            saturated / (air_density(air) * 1005.0 / 12.0 + 70.0);
    CHECK(flux(0.0, 293.0) == Approx(expected).epsilon(1e-9));
}

TEST_CASE("an hour of grass evaporates as in FAO's worked example",
          "[thermal][turbulence][fao][by_comparison]") {
    // FAO Irrigation and Drainage Paper 56, example 19, N'Diaye (Senegal), 14 to 15 h: 38 °C, 52 %,
    // 3.3 m/s, net radiation less soil heat 1.749 − 0.175 MJ/m²h: 0.63 mm/h. Its grass: aerodynamic
    // resistance 208/u, surface 70 s/m. Its formula is linear in T_s − T_a; ours is not.
    const AirState air{.temperature = 311.15, .pressure = 101.2e3, .vapour_pressure = 3445.0};
    ThermalSurface grass =
        surface_of(ConstantFilm{air_density(air) * dry_air_heat_capacity / (208.0 / 3.3)});
    grass.evaporation = {.minimum_resistance = 70.0, .wetness = 1.0};
    const AirFilm film = air_film(grass, louis_form(0.01, 0.001, 10.0, 2.0), air, 3.3);
    const double available = (1.749 - 0.175) * 1e6 / 3600.0;
    double low = 290.0, high = 340.0, evaporated = 0.0;
    for (int i = 0; i < 60; ++i) {
        const double t = 0.5 * (low + high);
        const Film f = ground_film(film, t);
        const double latent = -latent_heat(film, f, t).flux;
        (latent + f.h * (t - air.temperature) < available ? low : high) = t;
        evaporated = latent / latent_heat_of_vaporisation(air.temperature) * 3600.0;
    }
    CAPTURE(low - air.temperature);
    CHECK(evaporated == Approx(0.63).epsilon(0.03));
}
