#include "terrain/visibility/object_parts.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "terrain/objects/box.hpp"
#include "terrain/visibility/two_sides.hpp"

using namespace diurna;

namespace {

constexpr double pi = std::numbers::pi;

/// A triangle of ground, and behind it an object.
FacetSet with_ground() {
    FacetSet facets;
    const std::vector<Eigen::Vector3d> vertex{{-99, -99, 0}, {99, -99, 0}, {0, 99, 0}};
    const std::vector<std::array<std::uint32_t, 3>> triangle{{0, 1, 2}};
    const std::vector<MaterialId> material{MaterialId{0}};
    append_facets(facets, vertex, triangle, material, ObjectId{0});
    return facets;
}

/// A strip of flat faces round a horizontal axis.
ObjectMesh pipe(double radius, double length, int sides) {
    ObjectMesh mesh;
    for (int i = 0; i < sides; ++i) {
        const double angle = 2.0 * pi * i / sides;
        for (const double x : {0.0, length}) {
            mesh.vertex.push_back(
                Eigen::Vector3d(x, radius * std::cos(angle), 5.0 + radius * std::sin(angle))
                    .cast<float>());
        }
        const auto a = std::uint32_t(2 * i), b = std::uint32_t(2 * ((i + 1) % sides));
        for (const auto& t : {std::array{a, b, b + 1}, {a, b + 1, a + 1}}) {
            mesh.triangle.push_back(t);
            mesh.material.push_back(MaterialId{0});
        }
    }
    return mesh;
}

}  // namespace

TEST_CASE("walls and roof of a box are as large as they are", "[terrain][parts]") {
    const double heading = GENERATE(0.0, 33.0, 90.0);
    CAPTURE(heading);
    FacetSet facets = with_ground();
    append_facets(facets,
                  box({.base = {3.0, -7.0, 1.0},
                       .width = 20.0,
                       .depth = 10.0,
                       .height = 5.0,
                       .heading_deg = heading,
                       .sunk = 0.0}),
                  ObjectId{1});
    const ObjectBodies parts = object_parts(facets, 1);
    REQUIRE(parts.size.size() == facets.size() - 1);
    REQUIRE(parts.body.size() == 1);
    for (std::size_t f = 0; f < parts.size.size(); ++f) {
        const PartSize& size = parts.size[f];
        const Eigen::Vector3f& normal = facets.normal[f + 1];
        // Area over perimeter of rectangles; their mean chord is π times that (Cauchy).
        const bool roof = normal.z() > 0.5f;
        const Eigen::Vector2d front(std::sin(heading * pi / 180.0), std::cos(heading * pi / 180.0));
        const bool wide = std::abs(normal.head<2>().cast<double>().dot(front)) > 0.5;
        const double width = roof || wide ? 20.0 : 10.0, rise = roof ? 10.0 : 5.0;
        const double breadth = width * rise / (2.0 * (width + rise));
        CHECK(size.breadth == Approx(breadth).epsilon(1e-4));
        CHECK(size.chord == Approx(pi * breadth).epsilon(1e-4));
        if (!roof) CHECK(size.rise == Approx(rise).epsilon(1e-4));
        CHECK(size.across == Approx(std::sqrt(50.0)).epsilon(1e-4));
    }
    const BodyBox& body = parts.body.front();
    CHECK(body.half_length == Approx(10.0).epsilon(1e-4));
    CHECK(body.half_width == Approx(5.0).epsilon(1e-4));
    CHECK(body.middle.x() == Approx(3.0).margin(1e-3));
    CHECK(body.middle.y() == Approx(-7.0).margin(1e-3));
    CHECK(body.bottom == Approx(1.0).margin(1e-4));
    CHECK(body.top == Approx(6.0).margin(1e-4));
}

TEST_CASE("a pipe is as wide as its diameter, and not part of its neighbour", "[terrain][parts]") {
    FacetSet facets = with_ground();
    append_facets(facets, pipe(0.05, 2.0, 32), ObjectId{1});
    const std::size_t pipe_end = facets.size();
    append_facets(facets, pipe(0.5, 3.0, 8), ObjectId{2});
    const ObjectBodies parts = object_parts(facets, 1);
    CHECK(parts.body.size() == 2);
    CHECK(parts.size.front().across == Approx(0.1).epsilon(1e-3));
    CHECK(parts.size.back().across == Approx(1.0).epsilon(1e-3));
    // Eight sides of 45 degrees are strips of their own: 0.3827 m by 3 m.
    const double side = 2.0 * 0.5 * std::sin(pi / 8.0);
    CHECK(parts.size[pipe_end].breadth == Approx(side * 3.0 / (2.0 * (side + 3.0))).epsilon(1e-3));
}

TEST_CASE("a sheet's sides are parts of their own, however it is tilted", "[terrain][parts]") {
    FacetSet facets = with_ground();
    const double slope = 40.0 * pi / 180.0;
    const Eigen::Vector3d up(0.0, 2.0 * std::cos(slope), 2.0 * std::sin(slope));
    const std::vector<Eigen::Vector3d> vertex{
        {0, 0, 1}, {3, 0, 1}, Eigen::Vector3d(3, 0, 1) + up, Eigen::Vector3d(0, 0, 1) + up};
    const std::vector<std::array<std::uint32_t, 3>> triangle{{0, 1, 2}, {0, 2, 3}};
    const std::vector<MaterialId> material(2, MaterialId{0});
    append_facets(facets, vertex, triangle, material, ObjectId{1});
    const std::vector<std::uint32_t> front{1, 2};
    append_backs(facets, front, material);
    const ObjectBodies parts = object_parts(facets, 1);
    REQUIRE(parts.size.size() == 4);
    for (const PartSize& size : parts.size) {
        CHECK(size.rise == Approx(2.0).epsilon(1e-5));
        CHECK(size.breadth == Approx(0.6).epsilon(1e-5));
    }
}
