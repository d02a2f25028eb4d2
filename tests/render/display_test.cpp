#include <catch2/catch.hpp>
#include <numeric>
#include <vector>

#include "render/instrument/display.hpp"

using namespace diurna;

TEST_CASE("linear gain spans two percentiles of the pixels", "[render][instrument]") {
    std::vector<std::uint16_t> counts(1001);
    std::iota(counts.begin(), counts.end(), std::uint16_t{1000});
    const auto shown = displayed(counts, {.bits = 14, .display = Display::linear});
    CHECK(shown[0] == 0);
    CHECK(int(shown[500]) == Approx(127.5).margin(1.0));
    CHECK(shown[1000] == 255);
    // From the hundredth share: 1010 is black yet, 1020 is no more.
    CHECK(shown[9] == 0);
    CHECK(shown[20] > 0);
    const auto hot = displayed(counts, {.bits = 14, .display = Display::linear, .black_hot = true});
    for (std::size_t p = 0; p < counts.size(); ++p) {
        REQUIRE(std::abs(int(hot[p]) + int(shown[p]) - 255) <= 1);
    }
}

TEST_CASE("gain and level put the level in the middle", "[render][instrument]") {
    const std::vector<std::uint16_t> counts{100, 400, 500, 600, 900};
    const auto shown =
        displayed(counts, {.bits = 10, .display = Display::manual, .level = 500.0, .span = 400.0});
    CHECK(shown == std::vector<std::uint8_t>{0, 64, 128, 191, 255});
}

TEST_CASE("a plateau gives counts that many pixels have no more than its share",
          "[render][instrument]") {
    // Half of the pixels are one count of sky, the other half 500 counts of ground.
    std::vector<std::uint16_t> counts(1000, 5000);
    std::iota(counts.begin() + 500, counts.end(), std::uint16_t{8000});
    const auto share_of_ground = [&](double plateau) {
        const auto shown =
            displayed(counts, {.bits = 14, .display = Display::plateau, .plateau = plateau});
        return (int(shown[999]) - int(shown[500])) / 255.0;
    };
    // Whole equalisation: half of the grey levels. A plateau of 50 pixels: 500 of 550.
    CHECK(share_of_ground(1.0) == Approx(0.5).margin(0.01));
    CHECK(share_of_ground(0.05) == Approx(500.0 / 550.0).margin(0.01));
}
