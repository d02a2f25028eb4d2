#include "thermal/surface/ground_and_leaves.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/air/moist_air.hpp"
#include "materials/base/units.hpp"
#include "thermal/surface/frost.hpp"
#include "thermal/surface/plate_film.hpp"
#include "thermal/surface/standing_water.hpp"

using namespace diurna;

namespace {

/// Mild, half-dry air over ground of emissivity 0.96 in the sun.
SurfaceConditions midday(const ThermalSurface& surface, double air_temperature = 295.0,
                         double vapour_pressure = 1200.0) {
    const AirState air{
        .temperature = air_temperature, .pressure = 9.5e4, .vapour_pressure = vapour_pressure};
    SurfaceConditions c;
    c.air = air_film(surface, louis_form(0.02, 0.002, 10.0, 2.0), air, 3.0);
    c.natural = natural_film(1.0);
    c.wind_speed = 3.0;
    c.wind_height = 10.0;
    c.absorbed_solar = 500.0;
    c.longwave_in = 330.0;
    c.emissivity = 0.96;
    c.canopy = surface.canopy;
    return c;
}

ThermalSurface meadow() {
    ThermalSurface surface;
    surface.evaporation = {.minimum_resistance = 100.0, .wetness = 1.0};
    return surface;
}

}  // namespace

TEST_CASE("leaves and ground give the ground what the balance leaves over",
          "[thermal][surface_exchange][energy]") {
    ThermalSurface surface = meadow();
    surface.canopy = GENERATE(Canopy{}, Canopy{BigLeaf{8.0}}, Canopy{TwoSource{0.3, 100.0}},
                              Canopy{TwoSource{2.0, 100.0}}, Canopy{TwoSource{9.0, 100.0}});
    const double t = GENERATE(262.0, 272.9, 285.0, 310.0, 330.0);
    CAPTURE(surface.canopy.index(), t);
    SurfaceConditions c = midday(surface);
    c.internal = 20.0;
    c.frost_heat = 30.0;
    c.own_view = 0.2;
    const SurfaceTerms at = surface_terms(c, t);
    CHECK(at.balance.sum() + at.frost_melt == Approx(at.into_ground).margin(1e-7));
    const double step = 1e-4;
    const double slope =
        (surface_terms(c, t + step).into_ground - surface_terms(c, t - step).into_ground) /
        (2.0 * step);
    CHECK(at.into_ground_slope == Approx(slope).epsilon(2e-4));
    CHECK(at.into_ground_slope < 0.0);
}

TEST_CASE("a canopy without leaves is bare ground", "[thermal][surface_exchange][canopy]") {
    ThermalSurface bare = meadow(), sparse = meadow();
    sparse.canopy = TwoSource{.leaf_area = 0.0, .leaf_resistance = 100.0};
    for (const double t : {280.0, 300.0, 325.0}) {
        const SurfaceTerms a = surface_terms(midday(bare), t), b = surface_terms(midday(sparse), t);
        CHECK(b.into_ground == Approx(a.into_ground).margin(1e-8));
        CHECK(b.radiometric == Approx(t).margin(1e-9));
    }
}

TEST_CASE("a closed canopy is a big leaf that only radiates to its ground",
          "[thermal][surface_exchange][canopy]") {
    // Leaves without number over all of the ground, joined to it by ε² σ (T_l⁴ − T_g⁴): as one skin
    // of that conductance.
    ThermalSurface closed = meadow(), leaf = meadow();
    closed.canopy = TwoSource{.leaf_area = 1e5, .leaf_resistance = 100.0};
    const double ground = 290.0;
    const SurfaceTerms two = surface_terms(midday(closed), ground);
    const double joined =
        0.96 * 0.96 * stefan_boltzmann * (power4(two.leaf) - power4(ground)) / (two.leaf - ground);
    leaf.canopy = BigLeaf{joined};
    const SurfaceTerms one = surface_terms(midday(leaf), ground);
    CHECK(two.leaf == Approx(one.leaf).margin(1e-4));
    CHECK(two.radiometric == Approx(one.radiometric).margin(1e-4));
    CHECK(two.into_ground == Approx(one.into_ground).margin(1e-3));
    CHECK(two.leaf > ground + 3.0);
}

TEST_CASE("a skin that conducts without bound is the ground itself",
          "[thermal][surface_exchange][canopy]") {
    ThermalSurface bare = meadow(), leaf = meadow();
    leaf.canopy = BigLeaf{1e7};
    const SurfaceTerms a = surface_terms(midday(bare), 300.0),
                       b = surface_terms(midday(leaf), 300.0);
    CHECK(b.leaf == Approx(300.0).margin(1e-4));
    CHECK(b.into_ground == Approx(a.into_ground).margin(1e-2));
}

TEST_CASE("sunlit sparse cover has hot ground between cool leaves",
          "[thermal][surface_exchange][canopy]") {
    ThermalSurface shrub;
    shrub.canopy = TwoSource{.leaf_area = 0.5, .leaf_resistance = 200.0};
    SurfaceConditions c = midday(shrub, 303.0, 1500.0);
    c.absorbed_solar = 750.0;
    c.longwave_in = 380.0;
    double low = 280.0, high = 360.0;
    for (int i = 0; i < 60; ++i) {
        const double t = 0.5 * (low + high);
        (surface_terms(c, t).into_ground > 150.0 ? low : high) = t;  // a fifth goes into the soil
    }
    const SurfaceTerms terms = surface_terms(c, low);
    CAPTURE(low, terms.leaf, terms.radiometric);
    CHECK(terms.leaf < low - 5.0);
    CHECK(terms.leaf > 303.0);
    CHECK(terms.radiometric < low);
    CHECK(terms.radiometric > terms.leaf);
}

TEST_CASE("desert shrub under a July noon is as at Lucky Hills",
          "[thermal][surface_exchange][canopy]") {
    // Monsoon '90, Arizona (Norman et al. 1995; reference/thermal/parameterisations.md): warmest
    // soil 61 °C, warmest leaves 34 °C. Leaf area 0.5, dry soil that takes a fifth of what is left.
    ThermalSurface shrub;
    shrub.canopy = TwoSource{.leaf_area = 0.5, .leaf_resistance = 200.0};
    SurfaceConditions c = midday(shrub, 303.0, 1500.0);
    c.absorbed_solar = 800.0;
    c.longwave_in = 400.0;
    double low = 290.0, high = 360.0;
    for (int i = 0; i < 60; ++i) {
        const double t = 0.5 * (low + high);
        (surface_terms(c, t).into_ground > 130.0 ? low : high) = t;
    }
    const SurfaceTerms terms = surface_terms(c, low);
    CAPTURE(low, terms.leaf);
    CHECK(terms.leaf == Approx(kelvin(34.0)).margin(4.0));
    // The soil stays ten kelvin short of the warmest measured: no leaf keeps the wind from it
    // beyond the share that leaves cover.
    CHECK(low - terms.leaf > 12.0);
    CHECK(low < kelvin(61.0));
}

TEST_CASE("frost takes the heat of sublimation from the pressure over ice",
          "[thermal][surface_exchange][frost]") {
    // Saturation over ice, Goff & Gratch's table (WMO): −5, −10, −20, −30 °C.
    struct Row {
        double celsius, pascal;
    };
    const auto row =
        GENERATE(Row{-5.0, 401.5}, Row{-10.0, 259.7}, Row{-20.0, 103.2}, Row{-30.0, 37.98});
    CAPTURE(row.celsius);
    const double t = kelvin(row.celsius);
    const AirState dry{.temperature = t, .pressure = 9e4, .vapour_pressure = 0.0};
    ThermalSurface plate;
    plate.convection = ConstantFilm{15.0};
    const AirFilm film = air_film(plate, {}, dry, 1.0);
    const double flux = latent_heat_or_frost(film, {15.0, 0.0, 0.0}, 1.0, 0.0, t).flux;
    // L ρ 0.622 e / p · h / (ρ cp): 2.834 to 2.839 MJ/kg (Rogers & Yau, table 2.1). Murray's fit of
    // the pressure leaves the table by up to 1 % at −30 °C.
    const double expected = -2.8365e6 * 0.62198 * row.pascal / 9e4 * 15.0 / 1005.0;
    CHECK(flux == Approx(expected).epsilon(0.01));
    CHECK(latent_heat_of_sublimation(kelvin(-20.0)) == Approx(2.8383e6).epsilon(1e-3));
    // Just above melting it is water's.
    const double warm = latent_heat_or_frost(film, {15.0, 0.0, 0.0}, 1.0, 0.0, 273.2).flux;
    AirFilm water = film;
    water.wetness = 1.0;
    water.resistance = 0.0;
    CHECK(warm == Approx(latent_heat(water, {15.0, 0.0, 0.0}, 273.2).flux).epsilon(1e-9));
}

TEST_CASE("a trace of frost leaves ground in a lee as it is",
          "[thermal][surface_exchange][frost]") {
    // It hides a share d / (d + 5 z0) of the ground: of 1e-5 mm (50 nm) over grass 3e-7, so that no
    // term may change by more than that share of some 100 W/m2. In the lee a third of the wind: the
    // film of still air must be the lee's for frost too.
    ThermalSurface grass = meadow();
    const AirState air{.temperature = 276.0, .pressure = 9.5e4, .vapour_pressure = 550.0};
    FilmPart lee;
    lee.wind = 0.33f;
    for (const double wind : {0.3, 1.0, 2.0}) {
        SurfaceConditions bare;
        bare.air = air_film(grass, louis_form(0.02, 0.002, 10.0, 2.0), air, wind);
        bare.air.kind = FilmKind::sheltered_ground;
        bare.natural = facet_film(grass.convection, 1.0, lee);
        bare.longwave_in = 260.0;
        bare.emissivity = 0.96;
        bare.stores = true;
        SurfaceConditions frosted = bare;
        const SnowCover trace = snow_cover(1e-5, 0.02);
        frosted.snow_conductance = trace.conductance;
        frosted.phase_film = trace.phase_film;
        for (const double ground : {265.0, 270.0, 273.1, 275.0}) {
            CAPTURE(wind, ground);
            const SurfaceTerms a = surface_terms(bare, ground), b = surface_terms(frosted, ground);
            CHECK(b.into_ground == Approx(a.into_ground).margin(2e-3));
            CHECK(b.balance.sensible == Approx(a.balance.sensible).margin(2e-3));
            CHECK(b.radiometric == Approx(ground).margin(1e-3));
        }
    }
}
