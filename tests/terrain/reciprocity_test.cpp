#include "terrain/visibility/reciprocity.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/base/parallel.hpp"
#include "terrain/objects/box.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/bowl.hpp"

// In a hollow sphere every part sees every other as its share of the whole sphere's area.

using namespace diurna;
using std::numbers::pi;

namespace {

/// A bowl cut from a sphere of radius 1, facets of rather different sizes.
FacetSet hollow(int rings, int sectors, double half_angle) {
    return spherical_bowl(1.0, half_angle, rings, sectors);
}

/// rms over all pairs of factor − A_j/4π, over the rms of the factors.
double factor_error(const FacetSet& facets, const FacetViews& view) {
    double squares = 0.0, scale = 0.0;
    std::vector<float> row(facets.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
        std::fill(row.begin(), row.end(), 0.0f);
        for (auto k = view.others.row[f]; k < view.others.row[f + 1]; ++k) {
            row[view.others.facet[k]] = view.others.factor[k];
        }
        for (std::size_t g = 0; g < facets.size(); ++g) {
            if (g == f) continue;
            const double exact = facets.area[g] / (4.0 * pi);
            squares += (row[g] - exact) * (row[g] - exact);
            scale += exact * exact;
        }
    }
    return std::sqrt(squares / scale);
}

}  // namespace

TEST_CASE("exchange is made reciprocal and still adds up to one", "[terrain][exchange][by_trace]") {
    const FacetSet facets = hollow(16, 48, 0.5 * pi);
    FacetViews view = facet_views(facets, RayScene(facets), {.rays = 256});
    const double before = factor_error(facets, view);
    const ReciprocityReport report = make_reciprocal(facets, view, {.cut_off = 0.0, .passes = 200});
    CHECK(report.worst_closure < 2e-5);
    CHECK(report.left_out == 0);
    double worst = 0.0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        double whole = double{view.sky[f]} + view.below[f];
        for (auto k = view.others.row[f]; k < view.others.row[f + 1]; ++k) {
            whole += view.others.factor[k];
            const std::size_t g = view.others.facet[k];
            const auto begin = view.others.facet.begin() + view.others.row[g];
            const auto end = view.others.facet.begin() + view.others.row[g + 1];
            const auto back = std::lower_bound(begin, end, std::uint32_t(f));
            REQUIRE((back != end && *back == f));
            const double there = double{facets.area[f]} * view.others.factor[k];
            const double here = double{facets.area[g]} *
                                view.others.factor[std::size_t(back - view.others.facet.begin())];
            worst = std::max(worst, std::abs(there - here) / std::max(there, here));
        }
        CHECK(whole == Approx(1.0).epsilon(1e-6));
    }
    CHECK(worst < 1e-6);
    // Two estimates of each pair in one: the error of independent ones falls by √2 or more.
    const double after = factor_error(facets, view);
    CAPTURE(before, after);
    CHECK(after < before / 1.3);
}

TEST_CASE("small exchange is omitted and the rest scaled up", "[terrain][exchange]") {
    const FacetSet facets = hollow(16, 48, 0.4 * pi);
    FacetViews all = facet_views(facets, RayScene(facets), {.rays = 64});
    FacetViews few = all;
    make_reciprocal(facets, all, {.cut_off = 0.0});
    const ReciprocityReport report = make_reciprocal(facets, few, {.cut_off = 0.01});
    CHECK(report.left_out > 0);
    CHECK(few.others.facet.size() < all.others.facet.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
        double whole = double{few.sky[f]} + few.below[f];
        for (auto k = few.others.row[f]; k < few.others.row[f + 1]; ++k) {
            whole += few.others.factor[k];
        }
        CHECK(whole == Approx(1.0).epsilon(1e-6));
    }
}

TEST_CASE("memory for exchange grows with the facets, not with their pairs",
          "[terrain][exchange]") {
    const auto entries_a_facet = [](int rings, int sectors) {
        const FacetSet facets = hollow(rings, sectors, 0.5 * pi);
        FacetViews view = facet_views(facets, RayScene(facets), {.rays = 64});
        make_reciprocal(facets, view);
        return double(view.others.facet.size()) / double(facets.size());
    };
    const double coarse = entries_a_facet(12, 40), fine = entries_a_facet(48, 160);
    CAPTURE(coarse, fine);
    CHECK(fine < 64.0);  // half of 64 rays meet ground, each pair counts on both sides
    CHECK(fine < 1.3 * coarse);
}

TEST_CASE("two plates that see only each other share what both can give", "[terrain][exchange]") {
    // A small and a large one: the small one's view is the larger part of itself.
    FacetSet facets = hollow(1, 3, 0.3);
    FacetViews view = facet_views(facets, RayScene(facets), {.rays = 16});
    view.others = {.row = {0, 1, 2}, .facet = {1, 0}, .factor = {0.5f, 0.5f}};
    for (std::size_t f = 2; f < facets.size(); ++f) view.others.row.push_back(2);
    std::fill(view.sky.begin(), view.sky.end(), 0.5f);
    std::fill(view.below.begin(), view.below.end(), 0.0f);
    facets.area[0] = 1.0f;
    facets.area[1] = 4.0f;
    make_reciprocal(facets, view, {.passes = 200});
    CHECK(view.others.factor[0] == Approx(0.5).epsilon(0.02));
    CHECK(view.others.factor[1] == Approx(0.125).epsilon(0.02));
    CHECK(view.below[1] == Approx(0.375).epsilon(0.02));
    CHECK(view.below[2] == Approx(0.5));
}

TEST_CASE("small facets keep their view beside large ones that few rays meet",
          "[terrain][exchange][by_extreme]") {
    // A box of small facets on a plain of two large triangles: a wall sees half ground, half sky,
    // the plain's edge at 100 m hides 0.7 % of it, and walls of 3 m lose nothing more.
    FacetSet facets;
    const std::vector<Eigen::Vector3d> corner = {
        {-100, -100, 0}, {100, -100, 0}, {100, 100, 0}, {-100, 100, 0}};
    append_facets(facets, corner, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}},
                  std::vector<MaterialId>(2), ObjectId{0});
    append_facets(facets,
                  box({.base = {3, 5, 0},
                       .width = 4,
                       .depth = 4,
                       .height = 3,
                       .sunk = 0,
                       .largest_edge = 0.5}),
                  ObjectId{1});
    FacetViews view =
        facet_views(facets, RayScene(facets), {.rays = 64, .first_object = 2, .object_rays = 256});
    make_reciprocal(facets, view);
    double sum = 0.0, squares = 0.0;
    int walls = 0;
    for (std::size_t f = 2; f < facets.size(); ++f) {
        if (std::abs(facets.normal[f].z()) > 0.1f) continue;
        double ground = 0.0;
        for (auto k = view.others.row[f]; k < view.others.row[f + 1]; ++k) {
            if (view.others.facet[k] < 2) ground += view.others.factor[k];
        }
        sum += ground;
        squares += ground * ground;
        ++walls;
    }
    REQUIRE(walls > 100);
    const double mean = sum / walls;
    CHECK(mean == Approx(0.5).margin(0.01));
    CHECK(std::sqrt(squares / walls - mean * mean) < 0.015);
}

TEST_CASE("any number of threads, the same exchange",
          "[terrain][exchange][invariance][by_replication]") {
    const FacetSet facets = hollow(12, 40, 0.4 * pi);
    std::vector<std::vector<float>> factors;
    for (const int threads : {1, 3}) {
        set_thread_count(threads);
        FacetViews view = facet_views(facets, RayScene(facets), {.rays = 64});
        make_reciprocal(facets, view);
        factors.push_back(view.others.factor);
    }
    set_thread_count(0);
    CHECK(factors[0] == factors[1]);
}
