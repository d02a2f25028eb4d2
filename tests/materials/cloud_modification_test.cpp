#include "materials/atmosphere/cloud_modification.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace diurna;

TEST_CASE("cloud takes of global and diffuse light what Kasten and Czeplak measured",
          "[materials][cloud]") {
    // Their formulas at eighths of cover, with their clear sky's diffuse share of 0.3.
    constexpr std::array eighths = {0, 2, 4, 5, 6, 7, 8};
    constexpr std::array global = {1.0, 0.993, 0.929, 0.848, 0.718, 0.524, 0.250};
    constexpr std::array diffuse = {0.300, 0.344, 0.475, 0.573, 0.694, 0.836, 1.0};
    for (std::size_t i = 0; i < eighths.size(); ++i) {
        const CloudEffect left = kasten_czeplak(eighths[i] / 8.0);
        CAPTURE(eighths[i]);
        CHECK(left.global == Approx(global[i]).margin(6e-4));
        CHECK(1.0 - 0.7 * left.beam / left.global == Approx(diffuse[i]).margin(6e-4));
    }
}

TEST_CASE("a level cloud's cover and depth follow from its loss of beam and of all light",
          "[materials][cloud]") {
    std::mt19937 random(41);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 200; ++i) {
        const double fraction = 0.02 + 0.98 * unit(random), sun = 0.1 + 0.9 * unit(random);
        const double depth = std::exp(std::log(0.2) + unit(random) * std::log(300.0));
        const CloudEffect effect{.global = 1.0 - fraction * (1.0 - cloud_transmittance(depth, sun)),
                                 .beam = 1.0 - fraction * (1.0 - std::exp(-depth / sun))};
        const SunlitCloud cloud = cloud_of_effect(effect, sun);
        CAPTURE(i, fraction, depth, sun);
        CHECK(1.0 - cloud.fraction * (1.0 - std::exp(-cloud.optical_depth / sun)) ==
              Approx(effect.beam).margin(1e-9));
        CHECK(1.0 - cloud.fraction * (1.0 - cloud_transmittance(cloud.optical_depth, sun)) ==
              Approx(effect.global).margin(1e-3));
    }
}

TEST_CASE("what sky or instrument may say of clouds gives a cloud that can be",
          "[materials][cloud][stress]") {
    CHECK(cloud_of_effect({.global = 1.0, .beam = 1.0}, 0.5).fraction == 0.0);
    for (const double sun : {0.0, 0.01, 1.0}) {
        for (const CloudEffect effect :
             {CloudEffect{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.5}, {0.1, 0.9}, {0.3, 1e-9}}) {
            const SunlitCloud cloud = cloud_of_effect(effect, sun);
            CHECK(cloud.fraction >= 0.0);
            CHECK(cloud.fraction <= 1.0);
            CHECK(cloud.optical_depth > 0.0);
            CHECK(cloud.optical_depth <= 1000.0);
        }
    }
}

TEST_CASE("drops that absorb nothing pass what closed forms of two streams pass",
          "[materials][cloud]") {
    // Albedo (1 − g) τ / (2 + (1 − g) τ), and with √3 τ in place of τ, bracket Eddington's. The
    // ground's albedo of 0.2 adds what comes back from the cloud.
    for (const double depth : {5.0, 10.0, 25.0, 50.0}) {
        const double thin = 0.15 * depth / (2.0 + 0.15 * depth);
        const double thick = std::sqrt(3.0) * 0.15 * depth / (2.0 + std::sqrt(3.0) * 0.15 * depth);
        const double least = (1.0 - thick) / (1.0 - 0.2 * thin);
        const double most = (1.0 - thin) / (1.0 - 0.2 * thick);
        CHECK(cloud_transmittance(depth, 0.6) > least);
        CHECK(cloud_transmittance(depth, 0.6) < most);
    }
}

TEST_CASE("an overcast without a beam is as thick as the light it passes says",
          "[materials][cloud]") {
    for (const double sun : {0.2, 0.6, 1.0}) {
        for (const double passed : {0.05, 0.25, 0.5}) {
            const SunlitCloud cloud = cloud_of_effect({.global = passed, .beam = 0.0}, sun);
            CAPTURE(sun, passed, cloud.optical_depth);
            CHECK(cloud.fraction == 1.0);
            CHECK(cloud_transmittance(cloud.optical_depth, sun) == Approx(passed).margin(2e-3));
        }
    }
    // A beam that fades to none changes nothing at once.
    CHECK(cloud_of_effect({.global = 0.25, .beam = 1e-6}, 0.7).optical_depth ==
          Approx(cloud_of_effect({.global = 0.25, .beam = 0.0}, 0.7).optical_depth).epsilon(1e-4));
}
