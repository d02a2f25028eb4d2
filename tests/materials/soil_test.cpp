#include "materials/matter/soil.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace diurna;

TEST_CASE("soil conducts by Côté and Konrad's model", "[materials][soil]") {
    // 2005, Can. Geotech. J. 42, 443, by hand: k_dry = χ 10^(−η n); K_e = κ S / (1 + (κ − 1) S);
    // k_sat a geometric mean of grains and 0.60 (water) or 2.24 (ice). Natural mineral soil: χ
    // 0.75, η 1.2; crushed rock 1.70, 1.80; peat 0.30, 0.87. κ thawed 4.60, 3.55, 1.90, 0.60;
    // frozen 1.70, 0.95, 0.85, 0.25 of gravel, sand, silt and clay, peat.
    Soil loam = soil_named("loam");
    loam.porosity = 0.4;
    loam.grain_conductivity = 2.9;
    loam.saturation = 0.0;
    CHECK(soil_conductivity(loam, false) == Approx(0.24835).epsilon(1e-4));
    CHECK(soil_conductivity(loam, true) == Approx(0.24835).epsilon(1e-4));
    loam.saturation = 1.0;
    // 2.9^0.6 · 0.6^0.4 = 1.89426 · 0.81519; frozen · 2.24^0.4 = 1.38070.
    CHECK(soil_conductivity(loam, false) == Approx(1.54418).epsilon(1e-4));
    CHECK(soil_conductivity(loam, true) == Approx(2.61540).epsilon(1e-4));
    loam.saturation = 0.5;
    // K_e = 0.95 / 1.45 = 0.655172; frozen 0.425 / 0.925 = 0.459459.
    CHECK(soil_conductivity(loam, false) == Approx(1.09734).epsilon(1e-4));
    CHECK(soil_conductivity(loam, true) == Approx(1.33591).epsilon(1e-4));

    Soil rock = soil_named("gravel");
    rock.porosity = 0.3;
    rock.saturation = 0.0;
    CHECK(soil_conductivity(rock, false) == Approx(0.49028).epsilon(1e-4));
    rock.saturation = 0.2;  // K_e = 0.92 / 1.72
    const double saturated = std::pow(rock.grain_conductivity, 0.7) * std::pow(0.6, 0.3);
    CHECK(soil_conductivity(rock, false) ==
          Approx(0.49028 + (saturated - 0.49028) * 0.534884).epsilon(1e-4));
    Soil peat = soil_named("peat");
    peat.saturation = 0.0;
    CHECK(soil_conductivity(peat, false) == Approx(0.30 * std::pow(10.0, -0.87 * 0.85)));
    CHECK(soil_named("sand").kappa == 3.55);
    CHECK(soil_named("sand").kappa_frozen == 0.95);
}

TEST_CASE("moist loam lies within 0.15 W/mK of Johansen's model", "[materials][soil]") {
    // Johansen 1975: k_dry = (0.135 ρ + 64.7) / (2700 − 0.947 ρ), K_e = log10 S + 1 for fine soil:
    // the other accepted model (reference/thermal/parameterisations.md), valid above S = 0.1.
    for (double saturation = 0.15; saturation <= 1.0; saturation += 0.05) {
        Soil loam = soil_named("loam");
        loam.saturation = saturation;
        const double density = 2700.0 * (1.0 - loam.porosity);
        const double dry = (0.135 * density + 64.7) / (2700.0 - 0.947 * density);
        const double wet =
            std::pow(loam.grain_conductivity, 1.0 - loam.porosity) * std::pow(0.57, loam.porosity);
        const double johansen = dry + (wet - dry) * (std::log10(saturation) + 1.0);
        CAPTURE(saturation, johansen);
        CHECK(soil_conductivity(loam, false) == Approx(johansen).margin(0.25));
        if (saturation > 0.35) {
            CHECK(soil_conductivity(loam, false) == Approx(johansen).margin(0.15));
        }
    }
}

TEST_CASE("a soil layer holds its grains' heat, its water's and what freezes",
          "[materials][soil]") {
    Soil loam = soil_named("loam");
    loam.saturation = 0.5;
    const Layer layer = soil_layer(loam, 1.0);
    const double water = 1000.0 * 0.5 * loam.porosity, grains = 2640.0 * (1.0 - loam.porosity);
    CHECK(layer.density == Approx(water + grains));
    CHECK(layer.density * layer.heat_capacity == Approx(grains * 890.0 + water * 4180.0));
    const auto& freezing = std::get<Freezing>(layer.law);
    CHECK(freezing.water == Approx(water));
    CHECK(layer.density * freezing.frozen_heat_capacity == Approx(grains * 890.0 + water * 2100.0));
    CHECK(freezing.frozen_conductivity > layer.conductivity);
    loam.saturation = 0.0;
    CHECK(std::holds_alternative<Constant>(soil_layer(loam, 1.0).law));
}
