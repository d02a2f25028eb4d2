#include "render/view/adaptive.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "render/view/cast_view.hpp"
#include "tests/support/render_scene.hpp"

using namespace diurna;

namespace {

/// Mean of what a pixel's samples show.
double mean_of(const View& view, std::size_t pixel, const Appearance& appearance) {
    double sum = double{view.sky[pixel]} * double{appearance.sky};
    for (std::uint32_t k = view.row[pixel]; k < view.row[pixel + 1]; ++k) {
        const Sighting& s = view.sighting[k];
        sum += double{s.weight} * double{appearance.facet[index(view.surface[s.target])]};
    }
    return sum;
}

double rms(const View& a, const View& b, const Appearance& appearance) {
    double sum = 0.0;
    for (std::size_t p = 0; p < a.pixels(); ++p) {
        sum += std::pow(mean_of(a, p, appearance) - mean_of(b, p, appearance), 2);
    }
    return std::sqrt(sum / double(a.pixels()));
}

/// Warm where facets face south-east, and by height.
Appearance warm_slopes(const FacetSet& facets) {
    Appearance appearance;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const Eigen::Vector3f& n = facets.normal[f];
        appearance.facet.push_back(290.0f + 20.0f * (n.x() - n.y()) +
                                   (facets.material[f] == MaterialId{0} ? 0.0f : 15.0f));
    }
    return appearance;
}

void add_square(FacetSet& facets, double x0, double x1, double z0, double z1, double north) {
    append_facets(facets,
                  std::vector<Eigen::Vector3d>{
                      {x0, north, z0}, {x1, north, z0}, {x1, north, z1}, {x0, north, z1}},
                  std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}},
                  std::vector<MaterialId>(2, MaterialId{0}), ObjectId{0});
}

}  // namespace

// One pixel in nine, half at 310 K and half at 290 K. Its variance by 16 samples is 16/15 · 100 and
// one border goes through it; with the mean over its neighbours A = 71.1 K² there, 17.8 K² beside
// it, and the mean of A^2/5 is 1.315. For 0.1 K the factor is (1.315 / 0.01)^2/3 = 25.9: it wants
// 142 samples and its neighbours 82.
TEST_CASE("samples go where the spread is, in proportion", "[render][adaptive]") {
    View view;
    view.width = 9;
    view.height = 1;
    view.surface = {SurfaceId{0}, SurfaceId{1}};
    view.sky.assign(9, 0.0f);
    view.row = {0};
    for (int p = 0; p < 9; ++p) {
        if (p == 4) {
            view.sighting.push_back({.target = 0, .weight = 0.5f});
            view.sighting.push_back({.target = 1, .weight = 0.5f});
        } else {
            view.sighting.push_back({.target = 0, .weight = 1.0f});
        }
        view.row.push_back(static_cast<std::uint32_t>(view.sighting.size()));
    }
    const Appearance appearance{.facet = {290.0f, 310.0f}, .sky = 250.0f};
    const std::vector<double> of_one = variance_of_one(view, {&appearance, 1}, 16);
    CHECK(of_one[4] == Approx(71.1).epsilon(1e-3));
    CHECK(of_one[3] == Approx(17.8).epsilon(2e-3));
    CHECK(samples_wanted(of_one, {.from = 16, .to = 256, .tolerance = 0.1}) ==
          std::vector<int>{16, 16, 16, 64, 128, 64, 16, 16, 16});
    CHECK(samples_wanted(of_one, {.from = 16, .to = 32, .tolerance = 0.1}) ==
          std::vector<int>{16, 16, 16, 32, 32, 32, 16, 16, 16});
    CHECK(samples_wanted(of_one, {.from = 16, .to = 256, .tolerance = 50.0}) ==
          std::vector<int>(9, 16));
}

TEST_CASE("only the requested pixels are cast, with unchanged results",
          "[render][adaptive][view]") {
    const FacetSet facets = testing::hilly_world();
    const RayScene scene(facets);
    const Observer eye = testing::hilly_observer();
    const View all = cast_view(scene, facets, eye, {.samples = 16, .seed = 5});
    std::vector<std::uint8_t> asked(all.pixels());
    for (std::size_t p = 0; p < asked.size(); ++p) asked[p] = p % 3 == 1;
    const View some = cast_view(scene, facets, eye, {.samples = 16, .seed = 5, .asked = asked});
    const Appearance appearance = warm_slopes(facets);
    std::size_t seen = 0;
    for (std::size_t p = 0; p < asked.size(); ++p) {
        if (asked[p] == 0) {
            CHECK(some.row[p] == some.row[p + 1]);
            CHECK(some.sky[p] == 0.0f);
        } else {
            CHECK(mean_of(some, p, appearance) ==
                  Approx(mean_of(all, p, appearance)).epsilon(1e-7));
            ++seen;
        }
    }
    CHECK(some.rays == 16 * seen);
}

// The same rays spent alike on all pixels leave a greater error.
TEST_CASE("adaptive sampling is ahead of uniform", "[render][adaptive][by_replication]") {
    const FacetSet facets = testing::hilly_world();
    const RayScene scene(facets);
    Observer eye = testing::hilly_observer();
    eye.width = eye.height = 96;
    const Appearance appearance = warm_slopes(facets);
    const View truth = cast_view(scene, facets, eye, {.samples = 1024, .seed = 9});
    const View uniform = cast_view(scene, facets, eye, {.samples = 64, .seed = 3});
    const View adaptive =
        cast_adaptive_view(scene, facets, eye, {&appearance, 1},
                           {.from = 16, .to = 496, .tolerance = 0.08}, {.seed = 3});
    for (std::size_t p = 0; p < adaptive.pixels(); ++p) {
        double sum = double{adaptive.sky[p]};
        for (std::uint32_t k = adaptive.row[p]; k < adaptive.row[p + 1]; ++k) {
            sum += double{adaptive.sighting[k].weight};
        }
        if (std::abs(sum - 1.0) > 2e-6) FAIL("weights of pixel " << p << " add up to " << sum);
    }
    const double even = rms(uniform, truth, appearance), spent = rms(adaptive, truth, appearance);
    const double rays = double(adaptive.rays) / double(uniform.rays);
    CAPTURE(even, spent, rays);
    CHECK(rays < 1.0);
    CHECK(spent < 0.8 * even);
    CHECK(spent < 0.08);                                                        // the tolerance
    CHECK(sampling_error(adaptive, appearance) == Approx(spent).epsilon(0.3));  // of truth: small
}

// Squares of 1/17 of a pixel, one in 7 × 7 pixels: the worst share for being missed by 16.
TEST_CASE("what is small is not lost", "[render][adaptive][bias]") {
    constexpr int size = 105;
    constexpr double side = 0.24253562503633297;  // √(1/17)
    FacetSet facets;
    add_square(facets, -200, 200, -200, 200, 101.0);
    Observer eye;
    eye.projection = Projection::orthographic;
    eye.width = eye.height = size;
    eye.picture_width = size;  // a pixel is 1 m
    std::size_t count = 0;
    for (int j = 3; j < size; j += 7) {
        for (int i = 3; i < size; i += 7, ++count) {
            const double x = i - 0.5 * size + 0.1 + 0.6 * double(count % 11) / 11.0;
            const double z = j - 0.5 * size + 0.1 + 0.6 * double(count % 13) / 13.0;
            add_square(facets, x, x + side, z, z + side, 100.0);
        }
    }
    const RayScene scene(facets);
    Appearance appearance{.facet = std::vector<float>(facets.size(), 1.0f), .sky = 0.0f};
    appearance.facet[0] = appearance.facet[1] = 0.0f;  // contrast 1
    double total = 0.0, squares = 0.0, squares_of_16 = 0.0;
    constexpr int seeds = 4;
    for (int seed = 1; seed <= seeds; ++seed) {
        const ViewOptions options{.samples = 16, .seed = std::uint64_t(seed)};
        const View view = cast_adaptive_view(scene, facets, eye, {&appearance, 1},
                                             {.from = 16, .to = 256, .tolerance = 1e-3}, options);
        const View even = cast_view(scene, facets, eye, options);
        for (int j = 3; j < size; j += 7) {
            for (int i = 3; i < size; i += 7) {
                const auto p = static_cast<std::size_t>((size - 1 - j) * size + i);
                const double off = mean_of(view, p, appearance) - 1.0 / 17.0;
                total += off;
                squares += off * off;
                squares_of_16 += std::pow(mean_of(even, p, appearance) - 1.0 / 17.0, 2);
            }
        }
    }
    const double n = seeds * double(count), bias = total / n;
    CAPTURE(count, bias, std::sqrt(squares / n), std::sqrt(squares_of_16 / n));
    CHECK(std::abs(bias) < 0.02);
    CHECK(squares < squares_of_16);
}

TEST_CASE("an adaptive view is the same for any number of threads",
          "[render][adaptive][by_replication]") {
    const FacetSet facets = testing::hilly_world();
    const RayScene scene(facets);
    const Appearance appearance = warm_slopes(facets);
    std::vector<float> first;
    for (const int threads : {1, 2, 4}) {
        set_thread_count(threads);
        const View view = cast_adaptive_view(scene, facets, testing::hilly_observer(),
                                             {&appearance, 1}, {.tolerance = 0.3}, {.seed = 2});
        std::vector<float> weights;
        for (const Sighting& s : view.sighting) {
            weights.insert(weights.end(), {s.weight, view.range_of(s)});
        }
        if (first.empty()) first = weights;
        CHECK(weights == first);
    }
    set_thread_count(0);
}

TEST_CASE("adaptive sampling that makes no sense is refused", "[render][adaptive][input]") {
    const FacetSet facets = testing::hilly_world();
    const RayScene scene(facets);
    const Appearance appearance = warm_slopes(facets), none;
    const auto cast = [&](const Appearance& a, AdaptiveOptions options) {
        return cast_adaptive_view(scene, facets, testing::hilly_observer(), {&a, 1}, options);
    };
    CHECK_THROWS_AS(cast(appearance, {.from = 1}), InputError);
    CHECK_THROWS_AS(cast(appearance, {.from = 32, .to = 16}), InputError);
    CHECK_THROWS_AS(cast(appearance, {.tolerance = 0.0}), InputError);
    CHECK_THROWS_AS(cast(none, {}), InputError);
}
