#include "render/rays/plume.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/radiation/planck.hpp"
#include "render/rays/secondary_rays.hpp"
#include "tests/support/secondary_stage.hpp"

using namespace diurna;

TEST_CASE("a plume absorbs and emits by Beer and Lambert",
          "[render][secondary][plume][by_comparison]") {
    const double absorption = GENERATE(0.02, 0.3, 2.0), thickness = 4.0;
    SecondaryStage stage;
    stage.wall(60.0, 20.0, plain(0.0), 300.0f);
    stage.plume(20.0, thickness, absorption, 700.0);
    const auto seen = stage.look(stage.observer(5, 0.5), mwir);
    const double through = std::exp(-absorption * thickness);
    const double expected =
        through * band_radiance(mwir, 300.0) + (1.0 - through) * band_radiance(mwir, 700.0);
    CAPTURE(absorption);
    CHECK(seen.at(12) == Approx(expected).epsilon(2e-5));  // the ray's slant: 0.15 deg at most
    // In front of the cold sky it shines alone.
    SecondaryStage open;
    open.wall(-60.0, 1.0, plain(0.0), 300.0f);
    open.plume(20.0, thickness, absorption, 700.0);
    CHECK(open.look(open.observer(5, 0.5), mwir).at(12) ==
          Approx((1.0 - through) * band_radiance(mwir, 700.0)).epsilon(2e-5));
}

TEST_CASE("plumes in a row, and a camera inside one", "[render][secondary][plume]") {
    SecondaryStage stage;
    stage.wall(60.0, 20.0, plain(0.0), 300.0f);
    stage.plume(20.0, 2.0, 0.2, 500.0);
    stage.plume(30.0, 3.0, 0.1, 400.0);
    stage.plume(-1.0, 6.0, 0.05, 350.0);  // 5 m of it before the eye
    const double a = std::exp(-0.25), b = std::exp(-0.4), c = std::exp(-0.3);
    const double expected =
        (1 - a) * band_radiance(lwir, 350.0) +
        a * ((1 - b) * band_radiance(lwir, 500.0) +
             b * ((1 - c) * band_radiance(lwir, 400.0) + c * band_radiance(lwir, 300.0)));
    CHECK(stage.look(stage.observer(5, 0.5), lwir).at(12) == Approx(expected).epsilon(2e-5));
}

TEST_CASE("a plume's mesh must be closed", "[render][secondary][plume]") {
    SecondaryStage stage;
    stage.plume(20.0, 2.0, 0.2, 500.0);
    stage.plumes[0].triangle.pop_back();
    CHECK_THROWS_AS(PlumeScene(stage.plumes), InputError);
    Plume column{.name = "smoke",
                 .vertex = frustum_vertices({0, 0, 0}, 1.0, 3.0, 10.0, {4.0, 0.0}, 24),
                 .triangle = frustum_triangles(24),
                 .absorption = flat_spectrum(0.1),
                 .temperature = 300.0};
    const PlumeScene scene({&column, 1});
    // Through the axis at half height: the middle circle's diameter of 4 m, less what 24 sides cut.
    const auto chords = scene.chords({2.0, -20.0, 5.0}, {0.0, 1.0, 0.0}, 1e3);
    REQUIRE(chords.size() == 1);
    CHECK(chords[0].to - chords[0].from == Approx(4.0).epsilon(0.01));
    CHECK(scene.chords({2.0, -20.0, 5.0}, {0.0, 1.0, 0.0}, 20.0)[0].to == Approx(20.0));
}
