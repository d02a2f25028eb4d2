#include "terrain/raster/height_unit.hpp"

#include <catch2/catch.hpp>

using namespace diurna;

TEST_CASE("a unit of heights is known however it is spelled", "[terrain][dem][units]") {
    const double survey = 1200.0 / 3937.0;  // NIST: US survey foot
    const auto [spelling, metres] = GENERATE_COPY(table<const char*, double>({
        {"m", 1.0},
        {"Metre", 1.0},
        {"METERS", 1.0},
        {"[m]", 1.0},
        {"m above sea level", 1.0},
        {"meters (NAVD88)", 1.0},
        {"gpm", 1.0},
        {"dm", 0.1},
        {"Centimeters", 0.01},
        {"mm", 0.001},
        {"km", 1000.0},
        {"Kilometre", 1000.0},
        {"dam", 10.0},
        {"ft", 0.3048},
        {"Feet", 0.3048},
        {"FOOT", 0.3048},
        {"International Foot", 0.3048},
        {"foot_intl", 0.3048},
        {"US survey foot", survey},
        {"US_survey_feet", survey},
        {"us-ft", survey},
        {"ftUS", survey},
        {"Foot_US", survey},
        {"U.S. Survey Feet", survey},
        {"foot (US survey)", survey},
        {"survey foot", survey},
        {"m**2 s**-2", 1.0 / 9.80665},
        {"m2/s2", 1.0 / 9.80665},
        {"m^2/s^2", 1.0 / 9.80665},
        {"m² s⁻²", 1.0 / 9.80665},
        {"[(m^2)/(s^2)]", 1.0 / 9.80665},
        {"J kg-1", 1.0 / 9.80665},
    }));
    CAPTURE(spelling);
    const auto unit = height_unit(spelling);
    REQUIRE(unit);
    CHECK(unit->metres == Approx(metres).epsilon(1e-12));
}

TEST_CASE("a word that is no unit of heights is not read as one", "[terrain][dem][units]") {
    const char* word = GENERATE("K", "furlong", "British foot", "degree", "1", "m/s", "m2", "", "s",
                                "footprint", "Clarke's foot");
    CAPTURE(word);
    CHECK_FALSE(height_unit(word));
}
