#include "materials/matter/read_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "materials/matter/soil.hpp"

namespace diurna {

namespace {

double read_thickness(const Section& layer, Range range) {
    return layer.number("thickness_m", "thickness of the layer", range);
}

/// { thickness_m, soil = "loam", saturation, ... }
Layer read_soil(const Section& layer) {
    const std::string name = layer.word_or(
        "soil",
        "soil type instead of constants: conductivity by moisture after Cote and Konrad 2005",
        "loam", soil_names());
    Soil soil = soil_named(name);
    const char* own = "that of the soil";
    soil.saturation =
        layer.number("saturation", "with soil: share of the pores filled with water", {0.0, 1.0});
    soil.porosity =
        layer.number_or("porosity", "with soil: porosity", {soil.porosity, own}, {0.0, 0.95});
    soil.grain_conductivity =
        layer.number_or("grain_conductivity_W_mK", "with soil: conductivity of its grains",
                        {soil.grain_conductivity, own}, {0.05, 10.0});
    soil.grain_density = layer.number_or("grain_density_kg_m3", "with soil: density of its grains",
                                         {soil.grain_density, own}, {100.0, 8000.0});
    soil.grain_heat_capacity =
        layer.number_or("grain_heat_capacity_J_kgK", "with soil: heat capacity of its grains",
                        {soil.grain_heat_capacity, own}, {100.0, 5000.0});
    Layer result = soil_layer(soil, read_thickness(layer, {1e-5, 100.0}));
    if (!layer.flag_or("freezes", "with soil: its water freezes and melts", true)) {
        result.law = Constant{};
    }
    return result;
}

/// A layer that takes no heat to warm, or gives some, has no temperature: from 50 to 700 K, between
/// the poles of the moon and the day of Mercury, it must take a joule per kilogram and kelvin.
void check_polynomial(const Section& layer, const std::vector<double>& heat) {
    if (layer.has_mistakes()) return;
    for (double t = 50.0; t <= 700.0; t += 1.0) {
        double capacity = 0.0;
        for (std::size_t power = heat.size(); power-- > 0;) capacity = capacity * t + heat[power];
        if (capacity >= 1.0 && capacity <= 1e5) continue;
        layer.mistake("heat_capacity_polynomial",
                      fmt::format("gives a heat capacity of {:g} J/kgK at {:g} K, expected 1 to "
                                  "100000 from 50 to 700 K",
                                  capacity, t));
        return;
    }
}

/// What a layer of given constants does beyond them.
ThermalLaw read_conductivity_law(const Section& layer) {
    if (layer.has("freezing_water_kg_m3")) {
        return Freezing{
            .water = layer.number("freezing_water_kg_m3",
                                  "water that freezes at 273.15 K; the layer's constants are those "
                                  "of the thawed layer",
                                  {0.0, 1000.0}),
            .frozen_conductivity = layer.number(
                "frozen_conductivity_W_mK",
                "with freezing_water_kg_m3: conductivity of the frozen layer", {0.005, 500.0}),
            .frozen_heat_capacity = layer.number(
                "frozen_heat_capacity_J_kgK",
                "with freezing_water_kg_m3: heat capacity of the frozen layer", {50.0, 2e4})};
    }
    if (layer.has("melts") &&
        layer.flag_or("melts", "snow: stays at or below 273.15 K; meltwater runs off", false)) {
        return Melting{.held = layer.number_or(
                           "held_water",
                           "with melts: meltwater that snow retains, as a share of its mass", 0.05,
                           {0.0, 1.0})};
    }
    if (layer.has("cubic_K3")) {
        Radiating law{.cubic = layer.number("cubic_K3", "factor a of the conductivity 1 + a T^3",
                                            {0.0, 1e-3}),
                      .heat = {}};
        const std::vector<double> heat = layer.numbers(
            "heat_capacity_polynomial",
            "with cubic_K3: coefficients of T^0 to T^4 of the heat capacity in J/kgK", 5);
        if (heat.size() == 5) std::copy(heat.begin(), heat.end(), law.heat.begin());
        check_polynomial(layer, heat);
        return law;
    }
    return Constant{};
}

/// A layer of given constants.
Layer read_constants(const Section& layer) {
    return {
        .thickness = read_thickness(layer, {1e-5, 100.0}),
        .conductivity = layer.number(
            "conductivity_W_mK", "thermal conductivity; not with soil or regolith", {0.005, 500.0}),
        .density =
            layer.number("density_kg_m3", "density; not with soil or regolith", {0.1, 25000.0}),
        .heat_capacity = layer.number("heat_capacity_J_kgK",
                                      "specific heat; not with soil or regolith", {50.0, 2e4}),
        .law = read_conductivity_law(layer)};
}

bool is_regolith(const Section& layer) {
    return layer.has("regolith") &&
           layer.flag_or("regolith", "lunar dust in a vacuum, instead of constants", false);
}

}  // namespace

void read_layers(const Section& section, bool fresh, ThermalSurface& thermal) {
    if (!section.has("layers")) {
        if (fresh) {
            section.mistake("layers",
                            "missing, expected an array of { thickness_m, conductivity_W_mK, "
                            "density_kg_m3, heat_capacity_J_kgK }, from the surface downward");
        }
        return;
    }
    thermal.layers.clear();
    for (const Section& layer :
         section.sections("layers", "layers from the surface downward; required without `like`")) {
        if (layer.has("soil")) {
            thermal.layers.push_back(read_soil(layer));
        } else if (is_regolith(layer)) {
            for (const Layer& part : lunar_regolith(read_thickness(layer, {1e-3, 10.0}))) {
                thermal.layers.push_back(part);
            }
        } else {
            thermal.layers.push_back(read_constants(layer));
        }
    }
    if (thermal.layers.empty()) section.mistake("layers", "found no layer, expected at least one");
}

}  // namespace diurna
