// Shadows by pixel: their outline against the sun's projection of what casts them.

#include "render/view/pixel_sun.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "render/view/cast_view.hpp"
#include "terrain/place/site.hpp"
#include "tests/support/box_shadow.hpp"
#include "tests/support/hanging_sheets.hpp"

using namespace diurna;
using namespace diurna::testing;

TEST_CASE("a shadow's outline is that of the sun's rays, whatever the facets",
          "[render][pixel_sun][by_events]") {
    const double elevation = GENERATE(12.0, 25.0, 45.0, 65.0), edge = GENERATE(0.5, 1.5);
    BoxStage stage(edge, elevation);
    const BoxStage::Picture picture = stage.picture();
    const double by_facet = overlap(stage, picture.view, picture.by_facet),
                 by_pixel = overlap(stage, picture.view, picture.by_pixel);
    CAPTURE(elevation, edge, by_facet, by_pixel, picture.sun.pixel.size());
    CHECK(by_pixel >= 0.98);
    CHECK(by_pixel > by_facet);
}

// On level ground the shadow of an upright box is its foot and what the sides facing the sun throw:
// h cot(elevation) times the width across the sun. Seen from straight above, by area of pixels.
TEST_CASE("the light that a shadow takes is that of the area it covers", "[render][pixel_sun]") {
    const double elevation = GENERATE(20.0, 50.0), edge = GENERATE(0.5, 3.0);
    BoxStage stage(edge, elevation);
    stage.eye.projection = Projection::orthographic;
    stage.eye.picture_width = 40.0;
    stage.eye.width = stage.eye.height = 400;
    stage.eye.position = {0.0, 0.0, 50.0};
    stage.eye.elevation_deg = -90.0;
    const BoxStage::Picture picture = stage.picture();
    const auto taken = [&](const std::vector<float>& radiance) {
        const float lit = *std::max_element(radiance.begin(), radiance.end());
        double sum = 0.0;
        for (const float r : radiance) sum += 1.0 - double{r} / double{lit};
        return sum * 0.1 * 0.1;
    };
    const double azimuth = std::atan2(stage.to_sun.x(), stage.to_sun.y());
    const double across = 2.0 * box_half.x() * std::abs(std::cos(azimuth)) +
                          2.0 * box_half.y() * std::abs(std::sin(azimuth));
    const double length = box_half.z() * stage.to_sun.head<2>().norm() / stage.to_sun.z();
    const double expected = 4.0 * box_half.x() * box_half.y() + across * length;
    CAPTURE(elevation, edge, expected, taken(picture.by_facet));
    CHECK(taken(picture.by_pixel) == Approx(expected).epsilon(0.005));
}

TEST_CASE("ground without shadows costs no rays", "[render][pixel_sun][by_degenerate]") {
    BoxStage stage(1.0, 40.0, false);
    const BoxStage::Picture picture = stage.picture();
    CHECK(picture.sun.rays == 0);
    CHECK(picture.sun.sighting.empty());
    CHECK(picture.by_facet == picture.by_pixel);
}

// A net of cover c lets 1 − c of the beam through; the ground is seen from below it.
TEST_CASE("what lets the beam through dims the sun of a pixel", "[render][pixel_sun]") {
    const double cover = GENERATE(0.2, 0.65);
    Layers world;
    world.sheet(0.0, 20.0, 20, testing::material("ground", flat_spectrum(0.2)));
    world.sheet(3.0, 2.0, 4, net("net", cover));
    const Eigen::Vector3d to_sun = direction(140.0, 35.0);
    const RayScene rays(world.facets, world.passed());
    const std::vector<float> fraction = world.sunlit(to_sun, 4);
    Observer eye;
    eye.position = {0.0, 0.0, 2.5};
    eye.width = eye.height = 64;
    eye.horizontal_fov_deg = 120.0;
    eye.elevation_deg = -90.0;
    const View view = cast_view(rays, world.facets, eye, {.samples = 16});
    const PixelSun sun =
        cast_pixel_sun(view, {rays, world.facets, fraction, to_sun}, eye, {.samples = 16});
    REQUIRE(!sun.share.empty());
    std::size_t under = 0, open = 0;
    for (const float share : sun.share) {
        CHECK(double{share} >= 1.0 - cover - 1e-6);
        under += std::abs(double{share} - (1.0 - cover)) < 1e-6;
        open += share == 1.0f;
    }
    CHECK(under > 50);
    CHECK(open > 50);
    CHECK(under + open > 3 * sun.share.size() / 4);
}

TEST_CASE("the sun of pixels is the same on any number of threads",
          "[render][pixel_sun][by_replication]") {
    BoxStage stage(1.5, 30.0);
    const BoxStage::Picture all = stage.picture();
    set_thread_count(1);
    const BoxStage::Picture one = stage.picture();
    set_thread_count(0);
    CHECK(all.sun.share == one.sun.share);
    CHECK(all.by_pixel == one.by_pixel);
}
