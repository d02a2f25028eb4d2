#include "materials/matter/passed_light.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/matter/library.hpp"
#include "terrain/place/site.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/reciprocity.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/hanging_sheets.hpp"
#include "tests/support/render_scene.hpp"

using namespace diurna;
using namespace diurna::testing;
using std::numbers::pi;

// Of a beam, each square metre of a net's strips takes c and the ground what is left: nothing is
// lost between them. Two nets one above the other let the product through.
TEST_CASE("a net's cover and what passes it are all of the beam", "[whole][passed_light]") {
    const double cover = GENERATE(0.05, 0.35, 0.65, 1.0), second = GENERATE(0.0, 0.3);
    Layers world;
    world.sheet(0.0, 5.0, 8, testing::material("ground", flat_spectrum(0.2)));
    world.sheet(3.0, 60.0, 30, net("low", cover));
    world.sheet(5.0, 60.0, 30, net("high", second));
    const Eigen::Vector3d to_sun = direction(140.0, 35.0);
    const std::vector<float> fraction = world.sunlit(to_sun, 4);
    const auto share = [&](std::size_t f) { return double(fraction[f]); };
    const double ground = world.mean(0, 6.0, share), low = world.mean(1, 20.0, share),
                 high = world.mean(2, 20.0, share);
    CAPTURE(cover, second);
    CHECK(ground == Approx((1.0 - cover) * (1.0 - second)).margin(1e-6));
    CHECK(low == Approx(1.0 - second).epsilon(1e-6));
    CHECK(high == Approx(1.0).epsilon(1e-6));
    CHECK(ground + cover * low + second * high == Approx(1.0).epsilon(1e-6));
}

// A small facet under the middle of a square sees it with
// F = 2/π · x atan x · 2, x = A / √(1 + A²), A = half side over height (Modest, configuration 3),
// and the sky with all but what the strips hide of it. Below the sheet is a back: no sunlight.
TEST_CASE("under a net the sky is seen through its openings", "[whole][passed_light]") {
    const double cover = GENERATE(0.2, 0.65);
    Layers world;
    world.sheet(0.0, 0.5, 6, testing::material("ground", flat_spectrum(0.2)));
    world.sheet(3.0, 6.0, 30, net("net", cover));
    const std::vector<PassedLight> passed = world.passed();
    FacetViews views = facet_views(world.facets, RayScene(world.facets, passed), {.rays = 1024});
    for (const bool reciprocal : {false, true}) {
        if (reciprocal) make_reciprocal(world.facets, views, {.passed = passed});
        const double a = 6.0 / 3.0, x = a / std::sqrt(1.0 + a * a);
        const double seen = 4.0 / pi * x * std::atan(x);
        REQUIRE(seen > 0.5);
        const auto sky = [&](std::size_t f) { return double(views.sky[f]); };
        const auto hidden = [&](std::size_t f) { return double(views.hidden[f]); };
        const auto whole = [&](std::size_t f) {
            double sum = double(views.sky[f]) + double(views.below[f]) + double(views.hidden[f]);
            for (auto k = views.others.row[f]; k < views.others.row[f + 1]; ++k) {
                sum += double(views.others.factor[k]);
            }
            return std::abs(sum - 1.0);
        };
        CAPTURE(cover, reciprocal);
        CHECK(world.mean(0, 1.0, sky) == Approx(1.0 - cover * seen).epsilon(0.01));
        CHECK(world.mean(0, 1.0, hidden) == Approx(cover * seen).epsilon(0.01));
        CHECK(world.mean(0, 1.0, whole) < 1e-6);
        CHECK(world.mean(1, 20.0, sky) == Approx(1.0).epsilon(1e-6));
    }
}

// Fresnel: of unpolarised light a smooth surface of index n reflects the mean of
// [(cos i − n cos t)/(cos i + n cos t)]² and [(n cos i − cos t)/(n cos i + cos t)]²; what is let
// through goes as 1 − R, measured at 10°.
TEST_CASE("a pane lets the sun through by its angle", "[whole][passed_light]") {
    const double elevation_deg = GENERATE(80.0, 40.0, 15.0);
    Material glass = testing::material("glass", flat_spectrum(0.08), flat_spectrum(0.8));
    glass.see_through = true;
    glass.finish =
        Glossy{.roughness = 0.0, .metal = false, .index = flat_spectrum(1.5), .extinction = {}};
    Layers world;
    world.sheet(0.0, 2.0, 4, testing::material("ground", flat_spectrum(0.2)));
    world.sheet(3.0, 60.0, 30, glass);
    const auto entering = [](double cosine) {
        const double n = 1.5, inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
        const double s = (cosine - n * inside) / (cosine + n * inside);
        const double p = (n * cosine - inside) / (n * cosine + inside);
        return 1.0 - 0.5 * (s * s + p * p);
    };
    const std::vector<float> fraction = world.sunlit(direction(200.0, elevation_deg), 4);
    const double expected = 0.8 * entering(std::sin(elevation_deg * pi / 180.0)) /
                            entering(std::cos(10.0 * pi / 180.0));
    CAPTURE(elevation_deg);
    CHECK(world.mean(0, 3.0, [&](std::size_t f) { return double(fraction[f]); }) ==
          Approx(expected).epsilon(0.01));
}
