#include "terrain/objects/walls.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "terrain/objects/mesh_check.hpp"

using namespace diurna;

namespace {

double ground(double x, double y) { return 0.1 * x + 0.05 * y; }

/// Points every `step` along a ring's sides, on sloping ground.
std::vector<Eigen::Vector3d> border(const Ring& ring, double step) {
    std::vector<Eigen::Vector3d> points;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector2d a = ring[i], b = ring[(i + 1) % ring.size()];
        const int parts = static_cast<int>(std::ceil((b - a).norm() / step));
        for (int k = 0; k < parts; ++k) {
            const Eigen::Vector2d p = a + double(k) / parts * (b - a);
            points.emplace_back(p.x(), p.y(), ground(p.x(), p.y()));
        }
    }
    return points;
}

const Ring plan{{0, 0}, {20, 0}, {20, 4}, {12, 4}, {12, 10}, {0, 10}};  // an L

}  // namespace

TEST_CASE("walls stand on sloping ground without gap or overlap", "[terrain][object]") {
    const double step = GENERATE(0.4, 1.7, 50.0);
    CAPTURE(step);
    ObjectMesh walls;
    REQUIRE(append_walls({.ring = plan,
                          .top = 7.0,
                          .side = 2.0,
                          .lowest_row = 0.5,
                          .foot = border(plan, step),
                          .material = std::vector<MaterialId>(6, MaterialId{1})},
                         walls));
    const ObjectMesh mesh = welded(walls);
    // Area of the walls: the perimeter times the height over the sides' middles.
    double area = 0.0, expected = 0.0;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        const auto& [a, b, c] = mesh.triangle[t];
        const Eigen::Vector3f across =
            (mesh.vertex[b] - mesh.vertex[a]).cross(mesh.vertex[c] - mesh.vertex[a]);
        area += 0.5 * across.norm();
        CHECK(std::abs(across.z()) < 1e-4f);  // upright
    }
    for (std::size_t i = 0; i < plan.size(); ++i) {
        const Eigen::Vector2d a = plan[i], b = plan[(i + 1) % plan.size()], m = 0.5 * (a + b);
        expected += (b - a).norm() * (7.0 - ground(m.x(), m.y()));
    }
    CHECK(area == Approx(expected).epsilon(1e-5));
    // Open at the foot, along its own points, and at the eaves alone.
    const MeshCheck check = check_mesh(mesh.vertex, mesh.triangle);
    CHECK(check.rejected_triangles == 0);
    CHECK(check.boundary_edges == border(plan, step).size() + 10 + 2 + 4 + 3 + 6 + 5);
}

TEST_CASE("walls whose foot is not known stand on a level", "[terrain][object]") {
    auto foot = border(plan, 1.0);
    SECTION("none") { foot.clear(); }
    SECTION("a corner is missing") {
        foot.erase(foot.begin());
        foot.erase(foot.end() - 1);
        foot.erase(foot.begin());
    }
    SECTION("the wrong way round") { std::reverse(foot.begin(), foot.end()); }
    ObjectMesh mesh;
    CHECK_FALSE(append_walls({.ring = plan,
                              .bottom = -3.0,
                              .top = 7.0,
                              .side = 2.0,
                              .foot = foot,
                              .material = std::vector<MaterialId>(6, MaterialId{1})},
                             mesh));
    for (const auto& v : mesh.vertex) CHECK(v.z() >= -3.0f);
}

TEST_CASE("ground above the eaves swallows a wall", "[terrain][object][stress]") {
    ObjectMesh mesh;
    auto foot = border(plan, 1.0);
    for (auto& p : foot) p.z() += p.x() > 10.0 ? 20.0 : 0.0;
    REQUIRE(append_walls({.ring = plan,
                          .top = 7.0,
                          .side = 2.0,
                          .foot = foot,
                          .material = std::vector<MaterialId>(6, MaterialId{1})},
                         mesh));
    for (const auto& v : mesh.vertex) CHECK(v.z() <= 7.0f);
    for (const auto& [a, b, c] : mesh.triangle) {
        CHECK((mesh.vertex[b] - mesh.vertex[a]).cross(mesh.vertex[c] - mesh.vertex[a]).norm() >
              0.0f);
    }
}
