#include "terrain/facets.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numeric>

#include "materials/base/error.hpp"

using namespace diurna;

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

FacetSet square_grid(int n, double side) {
    std::vector<Eigen::Vector3d> vertex;
    Triangles triangle;
    for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) vertex.emplace_back(side * i / n, side * j / n, 1.0);
    }
    const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            triangle.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            triangle.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    }
    FacetSet facets;
    const std::vector<MaterialId> material(triangle.size(), MaterialId{3});
    append_facets(facets, vertex, triangle, material, ObjectId{0});
    return facets;
}

}  // namespace

TEST_CASE("facets keep area, normal and every property in step", "[terrain][facets]") {
    const FacetSet facets = square_grid(16, 100.0);
    CHECK(facets.size() == 512);
    CHECK(facets.corner.size() == facets.size());
    CHECK(facets.centroid.size() == facets.size());
    CHECK(facets.material.size() == facets.size());
    CHECK(facets.object.size() == facets.size());
    CHECK(facets.vertex.size() == 289);  // shared
    CHECK(std::accumulate(facets.area.begin(), facets.area.end(), 0.0) == Approx(1e4));
    for (const auto& normal : facets.normal) CHECK(normal == Eigen::Vector3f::UnitZ());
}

TEST_CASE("neighbours in space are neighbours in memory", "[terrain][facets]") {
    // Along Morton's curve the mean step is near one cell; in random order it would be half the
    // side.
    const FacetSet facets = square_grid(64, 64.0);
    double length = 0.0;
    for (std::size_t f = 1; f < facets.size(); ++f) {
        length += (facets.centroid[f] - facets.centroid[f - 1]).norm();
    }
    CHECK(length / static_cast<double>(facets.size()) < 1.5);
}

TEST_CASE("a triangle without area is skipped", "[terrain][facets][stress]") {
    const std::vector<Eigen::Vector3d> vertex{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
    const Triangles triangle{{0, 1, 2}, {0, 1, 3}, {1, 1, 3}};
    const std::vector<MaterialId> material{MaterialId{1}, MaterialId{2}, MaterialId{3}};
    FacetSet facets;
    append_facets(facets, vertex, triangle, material, ObjectId{7});
    REQUIRE(facets.size() == 1);
    CHECK(facets.material[0] == MaterialId{2});
    CHECK(facets.object[0] == ObjectId{7});
    CHECK(facets.area[0] == 0.5f);
}

TEST_CASE("a vertex that is not a number, too far or missing is refused",
          "[terrain][facets][stress]") {
    std::vector<Eigen::Vector3d> vertex{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    Triangles triangle{{0, 1, 2}};
    const std::vector<MaterialId> material{MaterialId{}};
    FacetSet facets;
    SECTION("not a number") { vertex[1].x() = std::numeric_limits<double>::quiet_NaN(); }
    SECTION("too far") { vertex[1].y() = 100.1e3; }
    SECTION("missing") { triangle[0][2] = 3; }
    CHECK_THROWS_AS(append_facets(facets, vertex, triangle, material, ObjectId{0}), InputError);
    CHECK(facets.size() == 0);
}
