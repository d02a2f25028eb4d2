#pragma once

#include <string>

#include "tests/support/small_scene.hpp"

/// The small scene with facets of every kind that the heat balance knows: evaporating ground, snow,
/// leaves as a skin and apart, a store of water, textures, walls with a room behind, thin plates
/// with air behind and heat inside. `time` stands in [time] for the pictures' spacing.
inline std::string every_kind_scene(const std::string& time) {
    const std::string folder = std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/";
    std::string text = with(with(small_scene(), "frame_every_s = 21600.0\n", time),
                            "radius_m = 4000.0", "radius_m = 2500.0");
    const auto patch = [&](const char* name, const char* material, const char* place) {
        text += std::string("[[ground]]\nname = \"") + name + "\"\nmaterial = \"" + material +
                "\"\nrectangle_m = [" + place + ", 200.0, 100.0, 0.0]\nlargest_edge_m = 60.0\n";
    };
    patch("pack", "snow", "600.0, 300.0");
    patch("scrub", "scrub", "-700.0, 300.0");
    patch("lawn", "lawn", "-300.0, 900.0");
    patch("deck", "puddled", "-700.0, -300.0");
    patch("meadow", "grass", "0.0, 600.0");
    return text + R"(texture = "patches"
[[texture]]
name = "patches"
std = 0.1
correlation_length_m = 30.0
[material.scrub]
like = "sand"
canopy = { kind = "two_source", leaf_area = 1.5, leaf_resistance_s_m = 200.0 }
[material.lawn]
like = "bare_soil"
roughness_length_m = 0.03
canopy = { kind = "big_leaf", skin_conductance_W_m2K = 10.0 }
evaporation = { kind = "resistance", minimum_s_m = 70.0, wetness = 1.0 }
[material.puddled]
like = "concrete"
store = { capacity_mm = 1.0, wet_albedo = 0.1 }
[material.hull]
like = "painted_steel"
layers = [{ thickness_m = 0.0015, conductivity_W_mK = 45.28, density_kg_m3 = 7824.0, heat_capacity_J_kgK = 500.0 }]
back = { kind = "exposed", emissivity = 0.9, albedo = 0.7 }
internal_heat_W_m2 = 300.0
[[object]]
name = "truck"
mesh = ")" +
           folder +
           R"(truck.obj"
place_m = [140.0, 0.0]
material = "hull"
largest_edge_m = 2.0
[object.parts]
windows = "glass"
wheels = "asphalt"
)";
}
