#include "thermal/surface/heat_balance.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "materials/base/units.hpp"
#include "thermal/column/column.hpp"
#include "thermal/kernels/surface_kernel.hpp"

using namespace diurna;

namespace {

struct Lanes {
    double heat[lanes], a[lanes], temperature[lanes], flux[lanes], slope[lanes];
    NaturalFilm natural[lanes];

    SurfaceCount solve(const AirFilm& air, std::size_t count, double b, double emissivity) {
        return solve_surface(air, {.count = count,
                                   .heat = heat,
                                   .natural = natural,
                                   .a = a,
                                   .b = b,
                                   .reference = 290.0,
                                   .emissivity = emissivity,
                                   .temperature = temperature,
                                   .flux = flux,
                                   .slope = slope});
    }
};

AirFilm constant_film(double h, double air_temperature) {
    AirFilm film{};
    film.neutral = h;
    film.air_temperature = air_temperature;
    film.heat_capacity = 1200.0;
    return film;
}

}  // namespace

TEST_CASE("steady balances of sun, sky and film have the quartic's roots",
          "[thermal][heat_balance][a8]") {
    // reference/thermal/analytic_cases.md, A8; emissivity 0.95.
    struct Case {
        double sun, longwave, h, air, temperature;
    };
    const auto c =
        GENERATE(Case{750, 330, 10, 300, 336.929171003}, Case{0, 250, 5, 280, 270.132016844},
                 Case{900, 400, 30, 310, 331.089448651}, Case{100, 300, 0, 290, 290.757781764});
    const double guess = GENERATE(2.0, 150.0, 300.0, 2000.0);
    CAPTURE(c.air, c.h, guess);
    Lanes lane{};
    lane.heat[0] = c.sun + 0.95 * c.longwave;
    lane.temperature[0] = guess;
    const SurfaceCount count = lane.solve(constant_film(c.h, c.air), 1, 0.0, 0.95);
    CHECK(count.iterations < 60);
    CHECK(lane.temperature[0] == Approx(c.temperature).epsilon(1e-11));
}

TEST_CASE("random surfaces are solved to rounding, whatever the guess",
          "[thermal][heat_balance][random]") {
    std::mt19937 random(20260715);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int trial = 0; trial < 300; ++trial) {
        CAPTURE(trial);
        ThermalSurface surface;
        surface.emissivity = unit(random);
        surface.roughness_length = std::pow(10.0, -4.0 + 4.0 * unit(random));
        surface.heat_roughness_length = 0.1 * surface.roughness_length;
        const int kind = trial % 5;
        if (kind == 1) surface.convection = Tarp{};
        if (kind == 2) surface.convection = Mowitt{};
        if (kind == 4) surface.convection = BodyFilm{};
        surface.evaporation = {.minimum_resistance = 300.0 * unit(random),
                               .wetness = trial % 3 ? unit(random) : 0.0};
        const AirState air{.temperature = 240.0 + 80.0 * unit(random),
                           .pressure = 9e4,
                           .vapour_pressure = 2000.0 * unit(random)};
        const AirFilm film = air_film(
            surface, louis_form(surface.roughness_length, surface.heat_roughness_length, 10.0, 2.0),
            air, 20.0 * unit(random) * unit(random));
        const double b = std::pow(10.0, 3.0 * unit(random));
        Lanes lane{};
        for (std::size_t l = 0; l < lanes; ++l) {
            lane.heat[l] = 1300.0 * unit(random);
            lane.a[l] = b * (60.0 * unit(random) - 30.0);
            lane.natural[l] = facet_film(surface.convection, 2.0 * unit(random) - 1.0, {});
            lane.temperature[l] = 200.0 + 200.0 * unit(random);
        }
        const SurfaceCount count = lane.solve(film, lanes, b, surface.emissivity);
        CHECK(count.iterations < 60);
        for (std::size_t l = 0; l < lanes; ++l) {
            const double t = lane.temperature[l];
            const HeatBalance terms = heat_balance(film, lane.natural[l], surface.emissivity,
                                                   {.absorbed_solar = lane.heat[l]}, t);
            const double left = terms.sum() + lane.a[l] - b * (t - 290.0);
            const double size = std::abs(lane.heat[l]) + std::abs(terms.longwave_out) +
                                std::abs(terms.sensible) + std::abs(terms.latent) + b * 30.0;
            CAPTURE(l, t);
            REQUIRE(std::abs(left) < 1e-9 * size);
        }
    }
}

TEST_CASE("no night has three surface temperatures", "[thermal][heat_balance][unique]") {
    // A cut-off stability function gives up to three roots in weak wind; the long tail must not.
    const LouisForm form = louis_form(0.02, 0.002, 10.0, 2.0);
    ThermalSurface surface;
    int several = 0;
    for (double wind = 0.3; wind < 4.0; wind += 0.1) {
        for (double ground = 0.5; ground < 20.0; ground *= 1.3) {
            for (double sky = 180.0; sky < 300.0; sky += 10.0) {
                const AirFilm film = air_film(
                    surface, form,
                    {.temperature = 280.0, .pressure = 1e5, .vapour_pressure = 500.0}, wind);
                int roots = 0;
                double before = 1.0;
                for (double t = 230.0; t < 290.0; t += 0.05) {
                    const HeatBalance terms = heat_balance(film, {}, 0.97, {.longwave = sky}, t);
                    const double left = terms.sum() + ground * (278.0 - t);
                    if ((left > 0.0) != (before > 0.0)) ++roots;
                    before = left;
                }
                several += roots > 1;
            }
        }
    }
    CHECK(several == 0);
}
