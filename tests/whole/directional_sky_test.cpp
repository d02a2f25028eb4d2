#include <catch2/catch.hpp>

#include "tests/support/black_plates.hpp"
#include "thermal/solve/solver.hpp"

// Plates of all slopes on open ground and in a street, against sums over directions one by one.

using namespace diurna;

using testing::tilt_deg;

TEST_CASE("black plates of all slopes are as warm as the sky they see", "[whole][sky][longwave]") {
    const bool street = GENERATE(false, true);
    const auto kelvin = testing::black_plates(street);
    for (std::size_t k = 0; k < tilt_deg.size(); ++k) {
        CAPTURE(street, tilt_deg[k]);
        CHECK(kelvin[k].solved == Approx(kelvin[k].exact).margin(0.05));
    }
}
