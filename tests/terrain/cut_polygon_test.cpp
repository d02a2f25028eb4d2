#include "terrain/objects/cut_polygon.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <random>
#include <set>

using namespace diurna;

namespace {

using Places = std::vector<Eigen::Vector3d>;

struct Sums {
    Eigen::Vector3d vector = Eigen::Vector3d::Zero();
    double area = 0.0;
};

Sums sums(const Places& corner, const CutPolygon& cut) {
    Sums sum;
    for (const auto& [a, b, c] : cut.triangle) {
        const Eigen::Vector3d part = 0.5 * (corner[b] - corner[a]).cross(corner[c] - corner[a]);
        sum.vector += part;
        sum.area += part.norm();
    }
    return sum;
}

/// Half the cross products around: Newell.
Eigen::Vector3d area_vector(const Places& corner) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < corner.size(); ++i) {
        sum += 0.5 * corner[i].cross(corner[(i + 1) % corner.size()]);
    }
    return sum;
}

/// Each side of the polygon is a side of one triangle, so that neighbours in a mesh meet it.
bool keeps_sides(std::size_t corners, const CutPolygon& cut) {
    std::set<std::pair<std::uint32_t, std::uint32_t>> sides;
    for (const auto& [a, b, c] : cut.triangle) {
        sides.insert({a, b});
        sides.insert({b, c});
        sides.insert({c, a});
    }
    for (std::uint32_t i = 0; i < corners; ++i) {
        if (sides.count({i, std::uint32_t((i + 1) % corners)}) == 0) return false;
    }
    return true;
}

/// In a tilted plane, away from the origin, from any corner, either way round.
Places laid(std::vector<Eigen::Vector2d> plan, std::size_t first, bool reversed) {
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    std::rotate(plan.begin(), plan.begin() + std::ptrdiff_t(first % plan.size()), plan.end());
    if (reversed) std::reverse(plan.begin(), plan.end());
    Places corner;
    for (const auto& p : plan) {
        const Eigen::Vector3d flat(p.x(), p.y(), 0.0);
        corner.push_back(turn * flat + Eigen::Vector3d(300.0, -20.0, 7.0));
    }
    return corner;
}

}  // namespace

TEST_CASE("a polygon's triangles have its area vector and its area", "[terrain][polygon]") {
    std::vector<Eigen::Vector2d> star, comb;
    for (int i = 0; i < 24; ++i) {
        const double r = i % 2 == 0 ? 6.0 : 1.5, angle = 0.2617993878 * i;
        star.emplace_back(r * std::cos(angle), r * std::sin(angle));
    }
    for (int i = 0; i < 20; ++i) {
        comb.emplace_back(double(i), 10.0);
        comb.emplace_back(i + 0.5, 0.5 + 0.01 * i);
    }
    comb.insert(comb.begin(), {20.0, 0.0});
    comb.insert(comb.begin(), {0.0, 0.0});
    std::reverse(comb.begin() + 2, comb.end());
    const std::map<std::string, std::vector<Eigen::Vector2d>> polygons{
        {"L", {{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}}},
        {"slot, with corners on straight sides",
         {{0, 6},
          {5, 6},
          {5, 4},
          {0, 4},
          {0, 0},
          {5, 0},
          {10, 0},
          {10, 5},
          {10, 10},
          {5, 10},
          {0, 10}}},
        {"arrow of four", {{0, 0}, {4, 0}, {1, 1}, {0, 4}}},
        {"square with a corner on each side",
         {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}},
        {"triangle with many corners on a side", {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {2, 3}}},
        {"frame, its hole joined by a bridge",
         {{0, 0}, {6, 0}, {6, 6}, {0, 6}, {0, 0}, {2, 2}, {2, 4}, {4, 4}, {4, 2}, {2, 2}}},
        {"star", star},
        {"comb", comb}};
    for (const auto& [name, plan] : polygons) {
        for (std::size_t first = 0; first < plan.size(); ++first) {
            for (const bool reversed : {false, true}) {
                CAPTURE(name, first, reversed);
                const Places corner = laid(plan, first, reversed);
                const CutPolygon cut = cut_polygon(corner);
                const Sums sum = sums(corner, cut);
                const Eigen::Vector3d whole = area_vector(corner);
                CHECK(cut.sound);
                CHECK((sum.vector - whole).norm() < 1e-9 * whole.norm());
                CHECK(sum.area == Approx(whole.norm()).epsilon(1e-9));  // none is turned over
                CHECK(cut.triangle.size() <= corner.size() - 2);
                CHECK((keeps_sides(corner.size(), cut) || name.starts_with("frame")));
            }
        }
    }
}

// A ring at random radii sees all of itself from its middle, so that it does not cross itself.
TEST_CASE("polygons at random are cut without a triangle turned over", "[terrain][polygon]") {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> radius(0.05, 1.0);
    for (int trial = 0; trial < 200; ++trial) {
        const int n = 4 + trial % 60;
        std::vector<Eigen::Vector2d> plan;
        for (int i = 0; i < n; ++i) {
            const double r = radius(random), angle = 6.283185307179586 * i / n;
            plan.emplace_back(r * std::cos(angle), r * std::sin(angle));
        }
        const Places corner = laid(plan, 0, trial % 2 == 0);
        const CutPolygon cut = cut_polygon(corner);
        CAPTURE(trial, n);
        CHECK(cut.sound);
        CHECK(cut.triangle.size() == std::size_t(n - 2));
        CHECK(sums(corner, cut).area == Approx(area_vector(corner).norm()).epsilon(1e-6));
    }
}

TEST_CASE("polygons that cross themselves are not sound", "[terrain][polygon]") {
    CHECK_FALSE(cut_polygon(Places{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}}).sound);
    CHECK_FALSE(cut_polygon(Places{{0, 0, 0}, {4, 0, 0}, {1, 3, 0}, {1, -1, 0}, {3, 3, 0}}).sound);
}

TEST_CASE("a bent quadrilateral keeps its corners and its area vector", "[terrain][polygon]") {
    const Places corner{{0, 0, 0}, {1, 0, 0.2}, {1, 1, 0}, {0, 1, 0.2}};
    const CutPolygon cut = cut_polygon(corner);
    CHECK(cut.sound);
    CHECK(cut.triangle.size() == 2);
    CHECK((sums(corner, cut).vector - area_vector(corner)).norm() < 1e-12);
}

TEST_CASE("corners in one place count once", "[terrain][polygon]") {
    const Places corner{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0},
                        {1, 1, 0}, {0, 1, 0}, {0, 0, 0}};
    const CutPolygon cut = cut_polygon(corner);
    CHECK(cut.sound);
    CHECK(sums(corner, cut).area == Approx(1.0));
    CHECK(cut_polygon(Places{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}}).triangle.size() <= 2);
}
