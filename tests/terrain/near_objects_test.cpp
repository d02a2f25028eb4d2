#include <Eigen/Core>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"

using namespace diurna;
using std::numbers::pi;

namespace {

using Corners = std::vector<Eigen::Vector3d>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/// Squares of a metre in plan from x = 8 to 14, two facets each, and behind them a plate at x = 0
/// that faces them, `wide` and `high`.
struct PlateOverGround {
    FacetSet facets;
    std::size_t ground = 0;

    PlateOverGround(double wide, double high, int from = 8, int to = 14) {
        Corners vertex;
        Triangles triangle;
        const auto square = [&](const Eigen::Vector3d& at, const Eigen::Vector3d& u,
                                const Eigen::Vector3d& v) {
            const auto first = static_cast<std::uint32_t>(vertex.size());
            for (const Eigen::Vector3d& p : {at, Eigen::Vector3d(at + u),
                                             Eigen::Vector3d(at + u + v), Eigen::Vector3d(at + v)})
                vertex.push_back(p);
            triangle.push_back({first, first + 1, first + 2});
            triangle.push_back({first, first + 2, first + 3});
        };
        const int rows = 7;  // of corners, north
        for (int x = from; x <= to; ++x) {
            for (int y = -3; y <= 3; ++y) vertex.emplace_back(x, y, 0.0);
        }
        for (int i = 0; i < to - from; ++i) {
            for (int j = 0; j + 1 < rows; ++j) {
                const auto at = static_cast<std::uint32_t>(i * rows + j), east = at + rows;
                triangle.push_back({at, east, east + 1});
                triangle.push_back({at, east + 1, at + 1});
            }
        }
        ground = triangle.size();
        square({0.0, -0.5 * wide, 0.0}, {0.0, wide, 0.0}, {0.0, 0.0, high});
        append_facets(facets, vertex, triangle, std::vector<MaterialId>(triangle.size()),
                      ObjectId{0});
    }
};

/// What an upright rectangle, its foot on the ground, hides of the sky from level ground before its
/// middle: dA1 to a rectangle at right angles with a corner on the normal's foot, C-4 of Howell's
/// catalogue of configuration factors, for either half.
double hidden_by_plate(double wide, double high, double distance, double aside) {
    const auto half = [&](double b) {
        const double x = distance / std::hypot(distance, high);
        return (std::atan(b / distance) - x * std::atan(b / std::hypot(distance, high))) /
               (2.0 * pi);
    };
    return half(0.5 * wide - aside) + half(0.5 * wide + aside);
}

}  // namespace

TEST_CASE("ground ten metres from a vehicle sees what a plate leaves of the sky, to 0.002",
          "[terrain][visibility][sky][near_objects]") {
    const PlateOverGround scene(3.0, 3.0);
    const std::vector<std::uint8_t> near(scene.ground, 1);
    const FacetViews few = facet_views(scene.facets, RayScene(scene.facets),
                                       {.first_object = scene.ground, .others = false});
    const FacetViews more =
        facet_views(scene.facets, RayScene(scene.facets),
                    {.first_object = scene.ground, .near_objects = near, .others = false});
    double error_of_few = 0.0, error = 0.0;
    for (std::size_t f = 0; f < scene.ground; ++f) {
        const Eigen::Vector3f& c = scene.facets.centroid[f];
        const double sky = 1.0 - hidden_by_plate(3.0, 3.0, double{c.x()}, double{c.y()});
        error_of_few += std::pow(double{few.sky[f]} - sky, 2) / double(scene.ground);
        error += std::pow(double{more.sky[f]} - sky, 2) / double(scene.ground);
        // Twice as many from fine facets that little is hidden from.
        CHECK((more.rays[f] == 2048 || more.rays[f] == 4096));
    }
    CAPTURE(std::sqrt(error_of_few), std::sqrt(error));
    CHECK(std::sqrt(error) < 0.002);
    CHECK(std::sqrt(error) < 0.25 * std::sqrt(error_of_few));
}

TEST_CASE("more samples at a shadow's edge find a facet's share three times as well",
          "[terrain][visibility][sun][near_objects]") {
    // The edge of the shadow of a very wide plate, parallel to it.
    const PlateOverGround scene(400.0, 3.0, 1, 8);
    const RayScene rays(scene.facets);
    double few = 0.0, more = 0.0;
    int edges = 0;
    for (double elevation = 25.0; elevation < 60.0; elevation += 0.7) {
        const double tangent = std::tan(elevation * pi / 180.0), edge = 3.0 / tangent;
        std::vector<float> plain(scene.facets.size()), refined(scene.facets.size());
        const Eigen::Vector3d to_sun = direction(270.0, elevation);
        sun_fraction(scene.facets, rays, to_sun, plain);
        sun_fraction(scene.facets, rays, to_sun, refined, {.edge_samples = 28});
        for (std::size_t f = 0; f < scene.ground; ++f) {
            // Right triangles of a square: below its diagonal, the right angle east, and above.
            const double from = std::floor(double{scene.facets.centroid[f].x()}), x = edge - from;
            if (x <= 0.02 || x >= 0.98) continue;
            const bool below = double{scene.facets.centroid[f].x()} - from > 0.5;
            const double lit = below ? 1.0 - x * x : (1.0 - x) * (1.0 - x);
            few += std::pow(double{plain[f]} - lit, 2);
            more += std::pow(double{refined[f]} - lit, 2);
            ++edges;
        }
    }
    REQUIRE(edges > 500);
    CAPTURE(std::sqrt(few / edges), std::sqrt(more / edges));
    CHECK(std::sqrt(more / edges) < 0.06);
    CHECK(std::sqrt(more) < 0.4 * std::sqrt(few));
}
