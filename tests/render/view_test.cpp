#include "render/view/view.hpp"

#include <catch2/catch.hpp>
#include <cstring>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "render/view/cast_view.hpp"
#include "render/view/pixel_rays.hpp"
#include "tests/support/render_scene.hpp"

using namespace diurna;

namespace {

/// A square of 2 · half [m] at height z.
FacetSet plain(double half, double z) {
    FacetSet facets;
    append_facets(facets,
                  std::vector<Eigen::Vector3d>{
                      {-half, -half, z}, {half, -half, z}, {half, half, z}, {-half, half, z}},
                  std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}},
                  std::vector<MaterialId>(2, MaterialId{0}), ObjectId{0});
    return facets;
}

}  // namespace

TEST_CASE("what a pixel sees adds up to one, and every facet named is seen",
          "[render][view][by_trace]") {
    const FacetSet facets = testing::hilly_world();
    const RayScene scene(facets);
    const int samples = GENERATE(1, 4, 16, 48);
    const View view =
        cast_view(scene, facets, testing::hilly_observer(), {.samples = samples, .seed = 3});
    REQUIRE(view.row.size() == view.pixels() + 1);
    std::vector<bool> seen(view.surface.size(), false);
    std::size_t open = 0, mixed = 0;
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        double sum = view.sky[p];
        for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
            const Sighting& s = view.sighting[k];
            sum += s.weight;
            seen[s.target] = true;
            CHECK(view.range_of(s) > 0.0f);
        }
        CHECK(sum == Approx(1.0).margin(1e-6));
        open += view.sky[p] == 1.0f;
        mixed += view.row[p + 1] - view.row[p] > 1;
    }
    CHECK(std::all_of(seen.begin(), seen.end(), [](bool s) { return s; }));
    CHECK(open > 100);
    CHECK((samples == 1 ? mixed == 0 : mixed > 100));
    CHECK(view.rays == view.pixels() * std::uint64_t(samples + 1));
}

// A plain 100 m below: the range under a depression angle d is 100 m / sin d.
TEST_CASE("ranges and heights are those of the geometry", "[render][view][by_comparison]") {
    const FacetSet facets = plain(2e4, -100.0);
    const RayScene scene(facets);
    Observer observer;
    observer.elevation_deg = -30.0;
    observer.width = 65;
    observer.height = 33;
    const View view = cast_view(scene, facets, observer);
    const PixelRays rays = pixel_rays(observer);
    for (const auto& [x, y] : {std::pair{32, 16}, {0, 0}, {64, 32}}) {
        const auto p = static_cast<std::size_t>(y * 65 + x);
        const Eigen::Vector3d towards = rays.towards(x + 0.5, y + 0.5);
        const double range = -100.0 / towards.z();
        CHECK(view.centre_range[p] == Approx(range).epsilon(1e-6));
        REQUIRE(view.row[p + 1] > view.row[p]);
        double mean = 0.0;
        for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
            const Sighting& s = view.sighting[k];
            mean += double{s.weight} * double{view.range_of(s)};
            CHECK(view.height_of(s) == Approx(-100.0).margin(0.01));
        }
        CHECK(mean == Approx(range).epsilon(2e-3));
    }
}

TEST_CASE("the share of sky follows the height of the horizon", "[render][view]") {
    // A level camera over a wide plain: half of the picture is sky, to within the plain's edge.
    const FacetSet facets = plain(9e4, -10.0);
    const RayScene scene(facets);
    Observer observer;
    observer.width = 40;
    observer.height = 40;
    observer.horizontal_fov_deg = 20.0;
    const View view = cast_view(scene, facets, observer);
    double sky = 0.0;
    for (std::size_t p = 0; p < view.pixels(); ++p) sky += double{view.sky[p]};
    CHECK(sky / double(view.pixels()) == Approx(0.5).margin(0.002));
    // The top row looks up by half the field less half a pixel.
    CHECK(view.sky[20] == 1.0f);
    CHECK(view.sky_zenith_deg[20] == Approx(90.0 - 9.75).margin(0.05));
}

TEST_CASE("a view is the same for any number of threads, and another for another seed",
          "[render][view][threads][by_replication]") {
    const FacetSet facets = testing::hilly_world();
    const RayScene scene(facets);
    const Observer observer = testing::hilly_observer();
    std::vector<View> views;
    for (const int threads : {1, 2, 4}) {
        set_thread_count(threads);
        views.push_back(cast_view(scene, facets, observer));
    }
    set_thread_count(0);
    const auto same = [](const View& a, const View& b) {
        return a.surface == b.surface && a.row == b.row && a.sky == b.sky &&
               a.sky_zenith_deg == b.sky_zenith_deg && a.centre == b.centre &&
               a.sighting.size() == b.sighting.size() &&
               std::memcmp(a.sighting.data(), b.sighting.data(),
                           a.sighting.size() * sizeof(Sighting)) == 0;
    };
    CHECK(same(views[0], views[1]));
    CHECK(same(views[0], views[2]));
    CHECK_FALSE(same(views[0], cast_view(scene, facets, observer, {.seed = 2})));
    CHECK_THROWS_AS(cast_view(scene, facets, observer, {.samples = 0}), InputError);
}
