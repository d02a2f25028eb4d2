#include "thermal/column/step_response.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

using namespace diurna;

namespace {

constexpr std::array<double, 5> seconds{120.0, 480.0, 1200.0, 2700.0, 14400.0};

}  // namespace

// Carslaw & Jaeger (1959), 2.7: T = (1 − e^x² erfc x)/h, x = h √t / √(kρc).
TEST_CASE("a half-space warms as its closed form says", "[thermal][column][by_closed_form]") {
    const double film = GENERATE(10.0, 25.0), conductivity = GENERATE(0.3, 1.7);
    ThermalSurface surface;
    surface.layers = {{20.0, conductivity, 2000.0, 900.0}};
    const auto found = step_response(surface, film, seconds);
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        const double x = film * std::sqrt(seconds[i] / (conductivity * 2000.0 * 900.0));
        CAPTURE(film, conductivity, seconds[i]);
        CHECK(found[i] == Approx((1.0 - std::exp(x * x) * std::erfc(x)) / film).epsilon(0.02));
    }
}

TEST_CASE("a thin plate warms as one body through both faces",
          "[thermal][column][by_closed_form]") {
    ThermalSurface plate;
    plate.layers = {{0.002, 45.0, 7800.0, 480.0}};
    plate.back = ExposedBack{};
    const double film = 12.0, held = 0.002 * 7800.0 * 480.0;
    const auto found = step_response(plate, film, seconds);
    for (std::size_t i = 0; i < seconds.size(); ++i) {
        const double expected = (1.0 - std::exp(-2.0 * film * seconds[i] / held)) / (2.0 * film);
        CHECK(found[i] == Approx(expected).epsilon(0.02));
    }
}

TEST_CASE("a surface without layers responds at once", "[thermal][column][by_degenerate]") {
    CHECK(step_response({}, 8.0, seconds).front() == Approx(0.125));
}
