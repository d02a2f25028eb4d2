#include "materials/base/random.hpp"

#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

using namespace diurna;

TEST_CASE("a stream is SplitMix64's", "[materials][random]") {
    // The first words after 1234567, as Rosetta Code prints them for that generator.
    constexpr std::uint64_t published[] = {6457827717110365317u, 3203168211198807973u,
                                           9817491932198370423u, 4593380528125082431u,
                                           16408922859458223821u};
    RandomStream stream{1234567};
    for (std::uint64_t n = 0; n < 5; ++n) {
        CHECK(hashed(1234567 + n * golden_step) == published[n]);
        CHECK(stream() == unit_interval(published[n]));
    }
    CHECK(unit_interval(~std::uint64_t{0}) < 1.0);
    CHECK(unit_interval(0) == 0.0);
}

TEST_CASE("a changed bit changes half of all bits", "[materials][random]") {
    // 4096 numbers, each bit once: the mean's standard error is below 0.2 %.
    double changed64 = 0.0, changed32 = 0.0;
    for (std::uint32_t n = 0; n < 4096; ++n) {
        for (int bit = 0; bit < 32; ++bit) {
            const std::uint32_t other = n ^ (1u << bit);
            changed64 += std::popcount(hashed(n) ^ hashed(other)) / 64.0;
            changed32 += std::popcount(spread_bits(n) ^ spread_bits(other)) / 32.0;
        }
    }
    CHECK(changed64 / (4096.0 * 32.0) == Approx(0.5).margin(0.01));
    CHECK(changed32 / (4096.0 * 32.0) == Approx(0.5).margin(0.01));
}

TEST_CASE("Roberts' steps are powers of the plastic number", "[materials][random]") {
    // g³ = g + 1; the steps are 1/g and 1/g².
    CHECK(even_step_x * even_step_x == Approx(even_step_y).epsilon(1e-15));
    const double g = 1.0 / even_step_x;
    CHECK(g * g * g == Approx(g + 1.0).epsilon(1e-15));
    CHECK(even_step32_x == static_cast<std::uint32_t>(std::lround(even_step_x * 0x1p32)));
    CHECK(even_step32_y == static_cast<std::uint32_t>(std::lround(even_step_y * 0x1p32)));
}

TEST_CASE("cells of samples are as square as their number allows", "[materials][random]") {
    CHECK(nearly_square(64) == std::pair(8, 8));
    CHECK(nearly_square(12) == std::pair(4, 3));
    CHECK(nearly_square(7) == std::pair(7, 1));
    CHECK(nearly_square(1) == std::pair(1, 1));
}
