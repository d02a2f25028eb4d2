#include "terrain/raster/written_height.hpp"

#include <catch2/catch.hpp>

using namespace diurna;

TEST_CASE("heights of buildings are read with their unit", "[terrain][shapes][units]") {
    const auto [text, metres] = GENERATE(table<const char*, double>({
        {"12", 12.0},
        {" 12.5 ", 12.5},
        {"12.5 m", 12.5},
        {"12.5m", 12.5},
        {"12,5", 12.5},
        {"12,5 m", 12.5},
        {"35 ft", 10.668},  // of 0.3048 m
        {"35ft", 10.668},
        {"35 Feet", 10.668},
        {"30'", 9.144},
        {"30′", 9.144},
        {"6'4\"", 1.9304},  // 4 inches of 0.0254 m
        {"6 ft 4 in", 1.9304},
        {"250 cm", 2.5},
        {"-3", -3.0},
    }));
    CAPTURE(text);
    const auto height = written_height(text);
    REQUIRE(height);
    CHECK(*height == Approx(metres).epsilon(1e-12));
}

TEST_CASE("what is no height is not read as the number it begins with",
          "[terrain][shapes][units]") {
    const char* text = GENERATE("3 storeys", "10-12", "1,200", "12;15", "approx 12", "12 m high",
                                "~12", "", "m", "6'4", "12.5.3", "nan", "1e3x");
    CAPTURE(text);
    CHECK_FALSE(written_height(text));
}
