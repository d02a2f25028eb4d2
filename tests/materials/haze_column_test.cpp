#include "materials/atmosphere/haze_column.hpp"

#include <catch2/catch.hpp>

using namespace diurna;

TEST_CASE("a visibility means the vertical optical depth that SMARTS gives it",
          "[materials][haze]") {
    // Its fit VISTAU for summer at 550 nm, and rural Ångström exponents to 380 and 500 nm.
    struct Row {
        double visibility_km, at_550, at_500, at_380;
    };
    for (const Row& row : {Row{50.0, 0.160, 0.180, 0.232}, Row{23.0, 0.325, 0.367, 0.472},
                           Row{10.0, 0.667, 0.753, 0.968}, Row{5.0, 1.173, 1.326, 1.703},
                           Row{2.0, 2.606, 2.945, 3.785}}) {
        const BandModel model{
            .profile = afgl_profile("MLS"), .aerosol = "rural", .visibility_km = row.visibility_km};
        CAPTURE(row.visibility_km);
        CHECK(aerosol_depth(model, 0.55) == Approx(row.at_550).epsilon(0.015));
        CHECK(aerosol_depth(model, 0.50) == Approx(row.at_500).epsilon(0.025));
        CHECK(aerosol_depth(model, 0.38) == Approx(row.at_380).epsilon(0.045));
    }
    CHECK(aerosol_depth({.profile = afgl_profile("MLS"), .aerosol = "none"}, 0.5) == 0.0);
}

TEST_CASE("rain is no haze", "[materials][haze]") {
    BandModel model{.profile = afgl_profile("US76"), .aerosol = "rural"};
    const double dry = aerosol_depth(model, 0.5);
    model.rain_mm_h = 10.0;
    CHECK(aerosol_depth(model, 0.5) == dry);
}
