#include "terrain/visibility/two_sides.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "terrain/objects/open_pieces.hpp"
#include "terrain/visibility/ray_bundles.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/reciprocity.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/hanging_sheets.hpp"

using namespace diurna;
using namespace diurna::testing;

namespace {

using Quad = std::array<Eigen::Vector3f, 4>;

/// Quads with vertices of their own, as many modellers write them.
ObjectMesh soup(const std::vector<Quad>& quads) {
    ObjectMesh mesh;
    for (const Quad& quad : quads) {
        const auto v = static_cast<std::uint32_t>(mesh.vertex.size());
        mesh.vertex.insert(mesh.vertex.end(), quad.begin(), quad.end());
        for (const std::uint32_t k : {1u, 2u}) {
            mesh.triangle.push_back({v, v + k, v + k + 1});
            mesh.material.push_back(MaterialId{0});
        }
    }
    return mesh;
}

std::vector<Quad> cube(float x) {
    const auto at = [&](float a, float b, float c) { return Eigen::Vector3f(x + a, b, c); };
    return {{at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)},
            {at(0, 1, 0), at(1, 1, 0), at(1, 0, 0), at(0, 0, 0)},
            {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)},
            {at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1)},
            {at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1)},
            {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)}};
}

int open_triangles(const std::vector<Quad>& quads) {
    int open = 0;
    for (const std::uint8_t is : open_pieces(soup(quads))) open += is;
    return open;
}

/// Ground under a sheet with two sides.
Layers sheet_over_ground() {
    Layers world;
    world.sheet(0.0, 6.0, 12, testing::material("ground", flat_spectrum(0.2)));
    world.sheet(2.0, 3.0, 6, testing::material("front", flat_spectrum(0.5)));
    world.all.push_back(testing::material("back", flat_spectrum(0.7)));
    std::vector<std::uint32_t> front;
    for (std::uint32_t f = 0; f < world.facets.size(); ++f) {
        if (index(world.facets.material[f]) == 1) front.push_back(f);
    }
    append_backs(world.facets, front, std::vector<MaterialId>(front.size(), MaterialId{2}));
    return world;
}

}  // namespace

TEST_CASE("a mesh is open where its edges have one triangle", "[terrain][objects][sheet]") {
    std::vector<Quad> box = cube(0.0f);
    CHECK(open_triangles(box) == 0);
    // Its lid in two halves: the other faces' edges are met end to end.
    const auto half = [](float from, float to) -> Quad {
        return {Eigen::Vector3f(from, 0, 1), {to, 0, 1}, {to, 1, 1}, {from, 1, 1}};
    };
    box[0] = half(0.0f, 0.4f);
    box.push_back(half(0.4f, 1.0f));
    CHECK(open_triangles(box) == 0);
    box.pop_back();  // half a lid
    CHECK(open_triangles(box) == 12);
    // A closed box, an open one beside it, a sheet.
    std::vector<Quad> three = cube(0.0f), other = cube(5.0f);
    three.insert(three.end(), other.begin() + 1, other.end());
    three.push_back({Eigen::Vector3f(9, 0, 0), {10, 0, 0}, {10, 1, 0}, {9, 1, 0}});
    CHECK(open_triangles(three) == 12);
}

TEST_CASE("a ray meets the side of a sheet that looks at it", "[terrain][visibility][sheet]") {
    const Layers world = sheet_over_ground();
    const std::vector<std::uint32_t> other = other_sides(world.facets);
    REQUIRE(other.size() == world.facets.size());
    const RayScene scene(world.facets);
    const Ray down{.origin = {0.3f, 0.2f, 5.0f}, .direction = {0.0f, 0.0f, -1.0f}};
    const Ray up{.origin = {0.3f, 0.2f, 1.0f}, .direction = {0.0f, 0.0f, 1.0f}};
    std::array<Hit, 2> hits;
    scene.closest(std::array{down, up}, hits);
    const std::size_t front = index(hits[0].facet), back = index(hits[1].facet);
    CHECK(index(world.facets.material[front]) == 1);
    CHECK(index(world.facets.material[back]) == 2);
    CHECK(other[front] == back);
    CHECK(other[back] == front);
    CHECK(other[0] == index(no_facet));
    CHECK(world.facets.normal[back].z() == -1.0f);
    CHECK(hits[0].range == Approx(3.0));
    CHECK(hits[1].range == Approx(1.0));
    RayBundles bundles(scene, 1);
    bundles.set_origin(up.origin);
    for (std::size_t i = 0; i < RayBundles::lanes; ++i) {
        bundles.direction_x[i] = bundles.direction_y[i] = 0.0f;
        bundles.direction_z[i] = i % 2 ? 1.0f : -1.0f;
    }
    bundles.closest(1);
    CHECK(bundles.facet[1] == back);
    CHECK(bundles.facet[0] < other.size());
    CHECK(world.facets.object[bundles.facet[0]] == ObjectId{0});
}

// Each side's row is a whole hemisphere, and what one sends another comes back by A F: nothing is
// lost between the faces of a sheet, ground and sky.
TEST_CASE("both sides of a sheet exchange with what they face", "[terrain][visibility][sheet]") {
    const Layers world = sheet_over_ground();
    FacetViews views = facet_views(world.facets, RayScene(world.facets), {.rays = 1024});
    make_reciprocal(world.facets, views);
    CHECK(views.hidden.empty());
    double ground_to_front = 0.0, front_sky = 0.0, back_ground = 0.0, ground_back = 0.0;
    for (std::size_t f = 0; f < world.facets.size(); ++f) {
        const std::size_t of = index(world.facets.material[f]);
        double row = double(views.sky[f]) + double(views.below[f]);
        for (auto k = views.others.row[f]; k < views.others.row[f + 1]; ++k) {
            const std::size_t seen = index(world.facets.material[views.others.facet[k]]);
            const double area = double(world.facets.area[f]) * double(views.others.factor[k]);
            row += double(views.others.factor[k]);
            if (of == 0 && seen == 1) ground_to_front += area;
            if (of == 0 && seen == 2) ground_back += area;
            if (of == 2 && seen == 0) back_ground += area;
        }
        REQUIRE(row == Approx(1.0).epsilon(1e-6));
        if (of == 1) front_sky += double(views.sky[f]);
    }
    CHECK(ground_to_front == 0.0);
    CHECK(front_sky == Approx(72.0).epsilon(1e-6));
    CHECK(back_ground == Approx(ground_back).epsilon(1e-6));
    CHECK(back_ground > 20.0);  // of 36 m²
}

// What ground and both sides of a sheet absorb of light from above, and send to the sky and beyond
// the edge, is all that arrived, after all bounces.
TEST_CASE("no light is lost between a sheet's sides, ground and sky",
          "[terrain][visibility][sheet][by_trace]") {
    const Layers world = sheet_over_ground();
    const FacetSet& facets = world.facets;
    FacetViews views = facet_views(facets, RayScene(facets), {.rays = 1024});
    make_reciprocal(facets, views);
    const double albedo[] = {0.2, 0.5, 0.7};
    const std::vector<float> sunlit = world.sunlit(direction(140.0, 50.0), 16);
    std::vector<double> direct(facets.size()), light(facets.size());
    double arriving = 0.0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        direct[f] = double(views.sky[f]) + 5.0 * double(sunlit[f]);
        arriving += double(facets.area[f]) * direct[f];
    }
    for (int bounce = 0; bounce < 60; ++bounce) {
        const std::vector<double> before = light;
        for (std::size_t f = 0; f < facets.size(); ++f) {
            light[f] = direct[f];
            for (auto k = views.others.row[f]; k < views.others.row[f + 1]; ++k) {
                const std::size_t from = views.others.facet[k];
                light[f] += double(views.others.factor[k]) * before[from] *
                            albedo[index(facets.material[from])];
            }
        }
    }
    double absorbed = 0.0, gone = 0.0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const double sent = albedo[index(facets.material[f])] * double(facets.area[f]) * light[f];
        absorbed += double(facets.area[f]) * light[f] - sent;
        gone += sent * (double(views.sky[f]) + double(views.below[f]));
    }
    CHECK(absorbed + gone == Approx(arriving).epsilon(1e-6));
}

// Of a beam what a sheet's faces take and what reaches the ground are all of it: within 1e-6 where
// a facet that the shadow's edge crosses has 4096 rays to the sun. With 4, as a run has, what is
// left is chance alone (4e-5 of this beam): it has no side, and falls with the number of rays.
TEST_CASE("a sheet and its shadow share a beam", "[terrain][visibility][sheet]") {
    Layers world;
    world.sheet(0.0, 20.0, 100, testing::material("ground", flat_spectrum(0.2)));
    std::vector<Eigen::Vector3d> vertex{{0, -1, 1}, {0, 1, 1}, {0.5, 1, 3}, {0.5, -1, 3}};
    world.all.push_back(testing::material("leaning", flat_spectrum(0.2)));
    const std::size_t first = world.facets.size();
    append_facets(world.facets, vertex,
                  std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}},
                  std::vector<MaterialId>(2, MaterialId{1}), ObjectId{1});
    append_backs(world.facets,
                 std::vector<std::uint32_t>{std::uint32_t(first), std::uint32_t(first + 1)},
                 std::vector<MaterialId>(2, MaterialId{1}));
    for (const double azimuth_deg : {80.0, 200.0, 280.0}) {
        const Eigen::Vector3d to_sun = direction(azimuth_deg, 40.0);
        const auto closes = [&](const std::vector<float>& fraction) {
            double taken = 0.0, whole = 0.0;
            for (std::size_t f = 0; f < fraction.size(); ++f) {
                const double into = double(world.facets.area[f]) *
                                    world.facets.normal[f].cast<double>().dot(to_sun);
                if (f < first) whole += into;
                taken += std::max(0.0, into) * double(fraction[f]);
            }
            return std::abs(taken / whole - 1.0);
        };
        std::vector<float> fraction = world.sunlit(to_sun, 4);
        CAPTURE(azimuth_deg);
        CHECK(closes(fraction) < 1e-4);
        std::vector<std::uint32_t> near;
        for (std::uint32_t f = 0; f < fraction.size(); ++f) {
            const bool about = world.facets.centroid[f].head<2>().norm() < 6.0f;
            if (about) near.push_back(f);
            if (!about) REQUIRE(fraction[f] == 1.0f);
        }
        sun_fraction(world.facets, RayScene(world.facets), to_sun, near, fraction,
                     {.samples = 4096});
        CHECK(closes(fraction) < 1e-6);
        int lit = 0;
        for (std::size_t f = first; f < world.facets.size(); ++f) lit += fraction[f] > 0.0f;
        CHECK(lit == 2);  // one side of two triangles
    }
}
