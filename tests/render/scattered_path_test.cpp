#include "render/path/scattered_path.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "materials/base/units.hpp"
#include "render/light/radiance.hpp"

using namespace diurna;

// The table against SunField's own sum along every line, for random places a picture could hold:
// towards a low sun through haze, away from a high one, with cloud, from the ground and from above.
TEST_CASE("the table of light scattered before a scene is within 0.1 % of the sum along lines",
          "[render][scattered][by_comparison]") {
    struct Case {
        const char* name;
        BandModel air;
        double sun_zenith_deg;
        PathExtent extent;
        ScatteredPath::Angles angles;
        double from_um, to_um;
    };
    const BandModel hazy{.profile = afgl_profile("MLS"), .aerosol = "rural", .visibility_km = 23.0};
    BandModel thick = hazy;
    thick.aerosol = "urban";
    thick.visibility_km = 5.0;
    BandModel cloudy = hazy;
    cloudy.cloud = {.fraction = 0.4, .base_km = 2.5};
    const PathExtent valley{.observer_height_km = 0.6,
                            .least_range_km = 0.2,
                            .most_range_km = 8.0,
                            .least_height_km = 0.25,
                            .most_height_km = 0.9};
    const PathExtent above{.observer_height_km = 3.0,
                           .least_range_km = 2.5,
                           .most_range_km = 20.0,
                           .least_height_km = 0.0,
                           .most_height_km = 0.7};
    const auto c =
        GENERATE_COPY(Case{"towards a low sun", hazy, 80.0, valley, {12.0, 50.0}, 0.4, 0.7},
                      Case{"away from the sun", hazy, 45.0, valley, {110.0, 150.0}, 0.4, 0.7},
                      Case{"thick haze", thick, 60.0, valley, {30.0, 75.0}, 0.7, 1.0},
                      Case{"below clouds", cloudy, 60.0, valley, {60.0, 100.0}, 0.4, 0.7},
                      Case{"from above", hazy, 30.0, above, {95.0, 140.0}, 0.7, 1.0},
                      Case{"medium waves", hazy, 60.0, valley, {40.0, 90.0}, 3.0, 5.0});
    const Band band = flat_band("", c.from_um, c.to_um, bin_edges_um());
    const SunField field(c.air, {.zenith_deg = c.sun_zenith_deg}, band.node_um);
    const ScatteredPath table(field, band, c.extent, c.angles);
    std::mt19937 random(3);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    double worst = 0.0, most = 0.0;
    int lines = 0;
    while (lines < 60) {
        const double range = between(c.extent.least_range_km, c.extent.most_range_km);
        const double height = between(c.extent.least_height_km, c.extent.most_height_km);
        const double rise = height - c.extent.observer_height_km;
        const double cosine = rise / range - range / (2.0 * earth_radius_km);
        const double azimuth = between(0.0, 180.0);
        if (std::abs(cosine) > 1.0) continue;
        const double zenith_deg = degrees(std::acos(cosine));
        const double angle = field.angle_from_sun_deg(zenith_deg, azimuth);
        if (angle < c.angles.least_deg || angle > c.angles.most_deg) continue;
        ++lines;
        const double right = band_sum_nodes(
            band,
            field.path(chord(c.extent.observer_height_km, height, range), zenith_deg, azimuth));
        const double found = table(table.towards(angle, cosine), static_cast<float>(1e3 * range),
                                   static_cast<float>(height));
        CHECK(right > 0.0);
        most = std::max(most, right);
        worst = std::max(worst, std::abs(found - right) / std::max(right, 0.02 * most));
    }
    fmt::print("  {:18} worst {:.3f} %, said {:.3f} %: {} ranges, {} heights, {} angles\n", c.name,
               100.0 * worst, 100.0 * table.error(), table.ranges(), table.heights(),
               table.angles());
    CAPTURE(c.name);
    CHECK(table.error() < 1e-3);
    CHECK(worst < 1e-3);
}

TEST_CASE("no path, no scattered light", "[render][scattered][by_degenerate]") {
    const BandModel air{.profile = afgl_profile("MLS"), .aerosol = "rural"};
    const Band band = flat_band("", 0.4, 0.7, bin_edges_um());
    const SunField field(air, {.zenith_deg = 40.0}, band.node_um);
    const ScatteredPath table(field, band,
                              {.observer_height_km = 0.1,
                               .least_range_km = 1e-6,
                               .most_range_km = 1.0,
                               .least_height_km = 0.1,
                               .most_height_km = 0.1},
                              {40.0, 40.0});
    const auto ahead = table.towards(40.0, 0.0);
    CHECK(table(ahead, 0.001f, 0.1f) == Approx(0.0).margin(1e-4 * table(ahead, 1000.0f, 0.1f)));
    // Thin air scatters in proportion to the way.
    CHECK(table(ahead, 20.0f, 0.1f) / table(ahead, 10.0f, 0.1f) == Approx(2.0).epsilon(0.01));
}
