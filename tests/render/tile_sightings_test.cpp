#include "render/view/tile_sightings.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/units.hpp"
#include "render/view/sky_angles.hpp"

using namespace diurna;

TEST_CASE("samples are sorted by facet with their ranges and heights", "[render][view]") {
    constexpr std::uint32_t none = static_cast<std::uint32_t>(index(no_facet));
    const std::array<std::uint32_t, 16> facet = {7, 7, none, 0, 7, 0,    9, 9,
                                                 9, 9, none, 7, 0, none, 5, 7};
    std::array<float, 16> range{}, height{};
    for (std::size_t s = 0; s < 16; ++s) {
        range[s] = static_cast<float>(100 + s);
        height[s] = static_cast<float>(s * s);
    }
    std::array<SampleGroup, 32> group;
    // The last two lanes do not count: facet 5 is not there, and 7 lacks its last.
    std::size_t size = group_samples(facet.data(), range.data(), height.data(), 14, group.data());
    REQUIRE(size == 3);
    CHECK(group[0].facet == 7);
    CHECK(group[0].parts == 4 * one_sample);
    CHECK(group[0].range == 400.0 + 0 + 1 + 4 + 11);
    CHECK(group[0].height == 0.0 + 1 + 16 + 121);
    CHECK(group[1].facet == 0);
    CHECK(group[1].range == 300.0 + 3 + 5 + 12);
    CHECK(group[2].facet == 9);
    CHECK(group[2].parts == 4 * one_sample);
    CHECK(group[2].height == 36.0 + 49 + 64 + 81);

    const std::size_t more =
        group_samples(facet.data(), range.data(), height.data(), 16, group.data() + size);
    size = merge_groups(group.data(), size, more);
    REQUIRE(size == 4);
    CHECK(group[0].parts == 9 * one_sample);
    CHECK(group[3].facet == 5);
}

TEST_CASE("angles of the sky are those of the arctangent", "[render][view]") {
    SkyDirections sky;
    std::vector<double> zenith, azimuth;
    for (int z = 1; z < 180; z += 7) {
        for (int a = -179; a < 180; a += 13) {
            const double across = std::sin(radians(z)), turned = radians(a + 30.0);
            const Eigen::Vector3d to(across * std::sin(turned), across * std::cos(turned),
                                     std::cos(radians(z)));
            const Eigen::Vector3f sum = (5.0 * to).cast<float>();
            sky.add(sky.size(), sum.data(), to, 0.3f);
            zenith.push_back(z);
            azimuth.push_back(a);
        }
    }
    std::vector<float> got_zenith, got_azimuth;
    sky_angles(sky, 30.0, got_zenith, got_azimuth);
    for (std::size_t k = 0; k < sky.size(); ++k) {
        CHECK(double{got_zenith[k]} == Approx(zenith[k]).margin(2e-5));
        CHECK(double{got_azimuth[k]} == Approx(azimuth[k]).margin(2e-5));
    }
}
