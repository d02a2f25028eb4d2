#pragma once

#include <fmt/format.h>

#include <string>

#include "tests/support/black_plain.hpp"

/// Thin black plates in a vacuum which nothing shines on, so that emissivity sigma T^4 = q: one
/// with 200 to 400 W/m2 from 6 to 12 h of the scene's clock and back to 200 at 18 h, in a plain
/// with 300 W/m2 all day, seen from 60 m above. As a scene in a folder of its own.
inline void lay_heated_plate(const ScratchFolder& folder, const std::string& more) {
    std::string weather =
        "time,air_temperature_K,shortwave_down_W_m2,direct_normal_W_m2,"
        "diffuse_W_m2,longwave_down_W_m2\n";
    for (int h = 0; h <= 48; ++h) {
        weather +=
            fmt::format("2026-07-{:02}T{:02}:00:00-04:00,290,0,0,0,0\n", 14 + h / 24, h % 24);
    }
    write_text(folder.path / "dark.csv", weather);
    std::string text = black_plain(R"(
[material.heated]
like = "black"
internal_schedule = [[6.0, 200.0], [12.0, 400.0], [18.0, 200.0]]
)" + plate_below_drone("heated", R"(["0.5-0.6", "8-12"])") +
                                   more);
    text = with(text, DIURNA_SOURCE_DIR "/scenes/jacksboro/weather.csv", "dark.csv");
    text = with(text, "albedo = 0.0",
                "albedo = 0.0\ninternal_heat_W_m2 = 300.0\n"
                "convection = { kind = \"constant\", value_W_m2K = 0.0 }\n"
                "evaporation = { kind = \"none\" }\nstore = { capacity_mm = 0 }\n"
                "bottom = { kind = \"flux\", value_W_m2 = 0.0 }\n"
                "layers = [{ thickness_m = 0.001, conductivity_W_mK = 1.0, density_kg_m3 = 10.0, "
                "heat_capacity_J_kgK = 1000.0 }]");
    lay(folder, text);
}
