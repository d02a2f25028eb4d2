#include "terrain/relief/smooth_normals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <vector>

using namespace diurna;

namespace {

/// 40 x 40 cells of 10 m, two triangles each, of heights as a function of east and north [m].
FacetSet mesh_of(const std::function<double(double, double)>& height) {
    FacetSet facets;
    for (int row = 0; row <= 40; ++row) {
        for (int column = 0; column <= 40; ++column) {
            const double x = 10.0 * column, y = 10.0 * row;
            facets.vertex.push_back(Eigen::Vector3d{x, y, height(x, y)}.cast<float>());
        }
    }
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const Eigen::Vector3f n =
            (facets.vertex[b] - facets.vertex[a]).cross(facets.vertex[c] - facets.vertex[a]);
        facets.corner.push_back({a, b, c});
        facets.normal.push_back(n.normalized());
        facets.area.push_back(0.5f * n.norm());
    };
    for (std::uint32_t row = 0; row < 40; ++row) {
        for (std::uint32_t column = 0; column < 40; ++column) {
            const std::uint32_t a = row * 41 + column;
            add(a, a + 1, a + 42);
            add(a, a + 42, a + 41);
        }
    }
    return facets;
}

/// A place at some share of a facet's two sides.
PlaceOnFacet inside(const FacetSet& facets, std::uint32_t f, float u, float v) {
    const auto& [a, b, c] = facets.corner[f];
    return {f, facets.vertex[a] + u * (facets.vertex[b] - facets.vertex[a]) +
                   v * (facets.vertex[c] - facets.vertex[a])};
}

double degrees_apart(const Eigen::Vector3f& a, const Eigen::Vector3d& b) {
    return std::acos(std::min(1.0, a.cast<double>().dot(b.normalized()))) * 180.0 / 3.14159265;
}

}  // namespace

TEST_CASE("the smooth normal of a plane is the plane's", "[terrain][normals][by_closed_form]") {
    const FacetSet plane = mesh_of([](double x, double y) { return 0.3 * x - 0.2 * y; });
    for (const std::uint32_t f : {0u, 77u, 1600u, 3199u}) {
        const std::vector<PlaceOnFacet> at{inside(plane, f, 0.2f, 0.3f)};
        CHECK(degrees_apart(smooth_normals(plane, 3200, at)[0], {-0.3, 0.2, 1.0}) < 0.05);
    }
}

// z = (x² + y²) / 2R: gradient (x, y) / R.
TEST_CASE("the smooth normal of a bowl is that of its gradient",
          "[terrain][normals][by_closed_form]") {
    const double radius = 500.0, middle = 200.0;
    const FacetSet bowl = mesh_of([=](double x, double y) {
        return ((x - middle) * (x - middle) + (y - middle) * (y - middle)) / (2.0 * radius);
    });
    double of_triangles = 0.0;
    for (std::uint32_t f = 1000; f < 2200; f += 7) {
        if (f % 80 < 4 || f % 80 > 75) continue;  // the mesh ends there
        const PlaceOnFacet at = inside(bowl, f, 0.1f, 0.7f);
        const Eigen::Vector3d exact{-(double{at.place.x()} - middle) / radius,
                                    -(double{at.place.y()} - middle) / radius, 1.0};
        CAPTURE(f);
        CHECK(degrees_apart(smooth_normals(bowl, 3200, {&at, 1})[0], exact) < 0.12);
        of_triangles = std::max(of_triangles, degrees_apart(bowl.normal[f], exact));
    }
    CHECK(of_triangles > 0.4);
}

TEST_CASE("a crease stays sharp", "[terrain][normals][by_degenerate]") {
    const FacetSet roof = mesh_of([](double x, double) { return 0.8 * std::abs(x - 200.0); });
    const std::uint32_t f = 2 * 20;  // the first beyond the crease
    const std::vector<PlaceOnFacet> at{inside(roof, f, 0.02f, 0.02f)};
    CHECK(degrees_apart(smooth_normals(roof, 3200, at)[0], {-0.8, 0.0, 1.0}) < 0.05);
}
