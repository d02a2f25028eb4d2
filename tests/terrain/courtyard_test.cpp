#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/error.hpp"
#include "terrain/objects/cut_polygon.hpp"
#include "terrain/objects/joined_ring.hpp"
#include "terrain/objects/prism.hpp"

// Buildings round courtyards: areas and volumes by hand.

using namespace diurna;

namespace {

Ring square(double from, double to) { return {{from, from}, {to, from}, {to, to}, {from, to}}; }

/// A regular polygon of n corners.
Ring polygon(const Eigen::Vector2d& middle, double radius, int n) {
    Ring ring;
    for (int k = 0; k < n; ++k) {
        const double angle = 2.0 * 3.14159265358979 * (k + 0.3) / n;
        ring.emplace_back(middle + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    return ring;
}

double area_of_polygon(double radius, int n) {
    return 0.5 * n * radius * radius * std::sin(2.0 * 3.14159265358979 / n);
}

struct Measures {
    double roof = 0.0, walls = 0.0, volume = 0.0;
    bool roof_up = true;
};

Measures measures(const ObjectMesh& mesh, float bottom) {
    Measures sum;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        const auto& [a, b, c] = mesh.triangle[t];
        const Eigen::Vector3f across =
            (mesh.vertex[b] - mesh.vertex[a]).cross(mesh.vertex[c] - mesh.vertex[a]);
        const bool roof = mesh.material[t] == MaterialId{2};
        (roof ? sum.roof : sum.walls) += 0.5 * across.norm();
        if (roof && !(across.z() > 0.0f)) sum.roof_up = false;
        sum.volume += across.dot(mesh.vertex[a] - Eigen::Vector3f(0, 0, bottom)) / 6.0;
    }
    return sum;
}

}  // namespace

TEST_CASE("a courtyard has no roof, and walls that face into it", "[terrain][object][courtyard]") {
    const bool turned = GENERATE(false, true);
    Ring court = square(4.0, 12.0);
    if (turned) std::reverse(court.begin(), court.end());
    const ObjectMesh mesh = prism({.ring = square(0.0, 16.0),
                                   .hole = {court},
                                   .bottom = 0.0,
                                   .top = 6.0,
                                   .wall = MaterialId{1},
                                   .roof = MaterialId{2}});
    const Measures sum = measures(mesh, 0.0f);
    CHECK(sum.roof == Approx(256.0 - 64.0));
    CHECK(sum.walls == Approx(6.0 * (64.0 + 32.0)));
    CHECK(sum.volume == Approx(6.0 * 192.0));  // over the open floor: walls face outward
    CHECK(sum.roof_up);
}

TEST_CASE("several courtyards, one of them touching the wall", "[terrain][object][courtyard]") {
    const Ring outer = polygon({0, 0}, 50.0, 40);
    std::vector<Ring> courts;
    double holes = 0.0;
    for (const auto& [x, y] : {std::pair{-20.0, 0.0}, {20.0, 1.0}, {0.0, 20.0}, {0.0, -20.0}}) {
        courts.push_back(polygon({x, y}, 7.0, 9));
        holes += area_of_polygon(7.0, 9);
    }
    courts.push_back({{-4, -4}, {4, -4}, {4, 4}, {-4, 4}});
    holes += 64.0;
    const ObjectMesh mesh = prism({.ring = outer,
                                   .hole = courts,
                                   .bottom = 0.0,
                                   .top = 10.0,
                                   .wall = MaterialId{1},
                                   .roof = MaterialId{2}});
    const Measures sum = measures(mesh, 0.0f);
    CHECK(sum.roof == Approx(area_of_polygon(50.0, 40) - holes).epsilon(1e-5));
    CHECK(sum.roof_up);
    // A corner of the court is a corner of the plan.
    const ObjectMesh touching = prism({.ring = square(0.0, 10.0),
                                       .hole = {{{0, 0}, {5, 2}, {2, 5}}},
                                       .bottom = 0.0,
                                       .top = 1.0,
                                       .wall = MaterialId{1},
                                       .roof = MaterialId{2}});
    CHECK(measures(touching, 0.0f).roof == Approx(100.0 - 10.5));
}

TEST_CASE("a hole that is not inside is refused", "[terrain][object][courtyard]") {
    CHECK_THROWS_WITH(prism({.ring = square(0.0, 10.0), .hole = {square(5.0, 15.0)}}),
                      Catch::Contains("hole"));
    CHECK_THROWS_WITH(prism({.ring = square(0.0, 10.0), .hole = {square(20.0, 25.0)}}),
                      Catch::Contains("hole"));
    CHECK(court_of(square(0.0, 0.2)).empty());  // 0.04 m²: a shaft
}
