#include "render/rays/secondary_samples.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/units.hpp"
#include "render/rays/follow_rays.hpp"
#include "tests/support/secondary_stage.hpp"

using namespace diurna;

namespace {

/// A wall half 290, half 330 K behind a pane, a net and a tilted mirror's place, by an edge that
/// runs through some pixels.
struct Edge {
    SecondaryStage stage;
    Observer eye;
    Edge() : eye(stage.observer(24, 6.0)) {
        stage.rectangle({{-40, 80, -40}, {0.13, 80, -40}, {0.31, 80, 40}, {-40, 80, 40}},
                        plain(0.0), 290.0f);
        stage.rectangle({{0.13, 80, -40}, {40, 80, -40}, {40, 80, 40}, {0.31, 80, 40}}, plain(0.0),
                        330.0f);
        stage.wall(30.0, 5.0, pane(0.0, 0.7), 300.0f);
    }

    SecondaryRays follow(int samples, const SecondarySampling* sampling) const {
        const RayScene scene(stage.facets);
        const MaterialLibrary materials(stage.all);
        const PlumeScene none(stage.plumes);
        View view = cast_view(scene, stage.facets, eye, {.samples = 16});
        const SecondaryScene place{
            .rays = scene, .facets = stage.facets, .materials = materials, .plumes = none};
        return follow_rays(view, place, eye, {.samples = samples}, sampling);
    }
    /// (pixel) share of the warm half.
    std::vector<double> warm(const SecondaryRays& secondary_rays) const {
        std::vector<double> share(24 * 24, 0.0);
        for (std::size_t k = 0; k < secondary_rays.pixel.size(); ++k) {
            for (const SecondaryRay& secondary : secondary_rays.of(k)) {
                if (secondary.before < 0 || secondary.kind != SecondaryRay::Kind::facet) continue;
                if (stage.temperature[secondary.what] > 320.0f) {
                    share[secondary_rays.pixel[k]] += double{secondary.weight};
                }
            }
        }
        return share;
    }
};

}  // namespace

// Behind a pane of transmittance 0.7 an edge of 40 K is one of 28 K; the edge's pixels are given by
// area: here by 4096 samples.
TEST_CASE("samples behind panes go where they are needed", "[render][secondary][adaptive]") {
    const Edge edge;
    Appearance look{.facet = edge.stage.temperature, .sky = 250.0f};
    const SecondarySampling sampling{{.from = 16, .to = 1024, .tolerance = 0.3}, {&look, 1}};
    const auto exact = edge.warm(edge.follow(4096, nullptr));
    const auto few = edge.warm(edge.follow(16, nullptr));
    const auto wanted = edge.warm(edge.follow(16, &sampling));
    double worst_few = 0.0, worst = 0.0;
    int flat = 0;
    for (std::size_t p = 0; p < exact.size(); ++p) {
        worst_few = std::max(worst_few, 28.0 * std::abs(few[p] - exact[p]));
        worst = std::max(worst, 28.0 * std::abs(wanted[p] - exact[p]));
        flat += exact[p] == 0.0 || exact[p] == 1.0;
    }
    CAPTURE(worst_few, worst, flat);
    CHECK(worst_few > 1.0);
    CHECK(worst < 0.6);
    CHECK(flat > 500);
}

// 16 values of 290 and 330 K alike: σ² = 426.7 K²; n = (426.7 / 0.5²)^2/3 = 143, the next doubling
// 256.
TEST_CASE("a pixel gets as many samples as its spread needs", "[render][secondary][adaptive]") {
    std::vector<double> values;
    for (int s = 0; s < 16; ++s) values.push_back(s % 2 == 0 ? 290.0 : 330.0);
    Appearance look;
    CHECK(samples_wanted(values, {{.from = 16, .to = 4096, .tolerance = 0.5}, {&look, 1}}) == 256);
    CHECK(samples_wanted(values, {{.from = 16, .to = 100, .tolerance = 0.5}, {&look, 1}}) == 64);
    values.assign(16, 300.0);
    CHECK(samples_wanted(values, {{.from = 16, .to = 4096, .tolerance = 0.5}, {&look, 1}}) == 16);
}

// A mirror in the lower half of a pixel is met by half of the samples. Its lobe must be sampled as
// wholly as where it fills the pixel, whatever the seed.
TEST_CASE("a rough mirror that fills half a pixel has its whole lobe", "[render][secondary]") {
    const bool upright = GENERATE(true, false);
    SecondaryStage stage;
    // Behind the eye a warm and a cold half, which meet aside or above where the mirror, turned by
    // 20 degrees, sends the eye's rays.
    constexpr double aside = 42.0;  // 50 m tan 40 degrees
    if (upright) {
        stage.rectangle({{-90, -20, -90}, {aside, -20, -90}, {aside, -20, 90}, {-90, -20, 90}},
                        plain(0.0), 290.0f, false);
        stage.rectangle({{aside, -20, -90}, {200, -20, -90}, {200, -20, 90}, {aside, -20, 90}},
                        plain(0.0), 330.0f, false);
    } else {
        stage.rectangle({{-90, -20, -90}, {200, -20, -90}, {200, -20, 0}, {-90, -20, 0}},
                        plain(0.0), 290.0f, false);
        stage.rectangle({{-90, -20, 0}, {200, -20, 0}, {200, -20, 90}, {-90, -20, 90}}, plain(0.0),
                        330.0f, false);
    }
    stage.rectangle({{-10, 26.36, -10}, {10, 33.64, -10}, {10, 33.64, 0}, {-10, 26.36, 0}},
                    metal(0.9, 0.3), 300.0f);
    stage.wall(40.0, 30.0, plain(0.0), 300.0f);
    const Observer eye = stage.observer(5, 2.0);
    const RayScene scene(stage.facets);
    const MaterialLibrary materials(stage.all);
    const PlumeScene none(stage.plumes);
    const SecondaryScene place{
        .rays = scene, .facets = stage.facets, .materials = materials, .plumes = none};
    struct Seen {
        double covered = 0.0, met = 0.0,
               warm = 0.0;  // of the mirror, and shares of what it mirrors
    };
    const auto seen_in = [&](std::size_t pixel, std::uint64_t seed) {
        View view = cast_view(scene, stage.facets, eye, {.samples = 16, .seed = seed});
        const SecondaryRays rays = follow_rays(view, place, eye, {.samples = 256, .seed = seed});
        Seen seen;
        for (std::size_t k = 0; k < rays.pixel.size(); ++k) {
            if (rays.pixel[k] != pixel) continue;
            for (const SecondaryRay& ray : rays.of(k)) {
                if (ray.before < 0) {
                    seen.covered += stage.all[index(stage.facets.material[ray.what])].needs_rays()
                                        ? double{ray.weight}
                                        : 0.0;
                } else if (ray.kind == SecondaryRay::Kind::facet) {
                    seen.met += double{ray.weight};
                    if (stage.temperature[ray.what] > 320.0f) seen.warm += double{ray.weight};
                }
            }
        }
        seen.warm /= seen.met;
        seen.met /= seen.covered;
        return seen;
    };
    constexpr std::size_t whole = 17, half = 12;  // below the middle, and the middle
    for (std::uint64_t seed = 1; seed < 9; ++seed) {
        const Seen in_whole = seen_in(whole, seed), in_half = seen_in(half, seed);
        CAPTURE(upright, seed);
        CHECK(in_whole.covered == Approx(1.0).epsilon(1e-5));
        CHECK(in_half.covered == Approx(0.5).margin(0.01));
        CHECK(in_half.met == Approx(in_whole.met).margin(0.04));
        CHECK(in_half.warm == Approx(in_whole.warm).margin(0.04));
    }
}

// Panes whose edges cut 1/20 of the pixels in a column: 16 samples of each pixel alone miss most or
// count them double; the view's 1024 samples know the share to 0.01, and followed rays only what is
// behind.
TEST_CASE("a pane's share of a pixel is that of the view", "[render][secondary]") {
    SecondaryStage stage;
    const Observer eye = stage.observer(9, 2.0);
    // [m] a pixel's width at 30 m
    const double width = 2.0 * 30.0 * std::tan(radians(1.0)) / 9.0, edge = 0.5 * width;
    stage.rectangle(
        {{edge - 0.05 * width, 30, -5}, {8, 30, -5}, {8, 30, 5}, {edge - 0.05 * width, 30, 5}},
        pane(0.0, 0.7), 300.0f);
    stage.wall(80.0, 40.0, plain(0.0), 330.0f);
    const RayScene scene(stage.facets);
    const MaterialLibrary materials(stage.all);
    const PlumeScene none(stage.plumes);
    const SecondaryScene place{
        .rays = scene, .facets = stage.facets, .materials = materials, .plumes = none};
    Appearance look{.facet = stage.temperature, .sky = 250.0f};
    const SecondarySampling sampling{{.from = 16, .to = 256, .tolerance = 0.3}, {&look, 1}};
    View view = cast_view(scene, stage.facets, eye, {.samples = 1024});
    const SecondaryRays rays = follow_rays(view, place, eye, {.samples = 16}, &sampling);
    int cut = 0;
    for (std::size_t k = 0; k < rays.pixel.size(); ++k) {
        if (rays.pixel[k] % 9 != 4) continue;
        double covered = 0.0, behind = 0.0, whole = 0.0;
        for (const SecondaryRay& ray : rays.of(k)) {
            const bool in_pane = stage.temperature[ray.what] < 310.0f;
            whole += ray.before < 0 ? double{ray.weight} : 0.0;
            covered += in_pane ? double{ray.weight} : 0.0;
            behind += ray.before >= 0 ? double{ray.weight} : 0.0;
        }
        ++cut;
        CHECK(covered == Approx(0.05).margin(0.01));
        CHECK(behind == Approx(covered).epsilon(1e-4));
        CHECK(whole == Approx(1.0).epsilon(1e-4));
    }
    CHECK(cut == 9);
}
