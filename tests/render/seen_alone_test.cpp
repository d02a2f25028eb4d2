#include "render/view/seen_alone.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/view/place_in_picture.hpp"

using namespace diurna;

namespace {

/// An upright square to the north or south of the eye [m]: from -half to half east and up.
FacetSet square(double north, double half) {
    const std::vector<Eigen::Vector3d> corner = {
        {-half, north, -half}, {half, north, -half}, {half, north, half}, {-half, north, half}};
    const std::vector<std::array<std::uint32_t, 3>> triangle = {{0, 1, 2}, {0, 2, 3}};
    const std::vector<MaterialId> material(2, MaterialId{});
    FacetSet facets;
    append_facets(facets, corner, triangle, material, ObjectId{1});
    return facets;
}

constexpr std::array<std::uint32_t, 2> both = {0, 1};

TEST_CASE("every pixel of a picture that an object fills is counted") {
    Observer observer;
    observer.horizontal_fov_deg = GENERATE(100.0, 4.0);
    observer.width = 157;
    observer.height = 119;
    const FacetSet wall = square(0.05, 10.0);  // 25000 pixels across: by one in many beyond
    const auto box = projected_box(observer, wall, both);
    REQUIRE(box);
    const SeenAlone seen = seen_alone(observer, RayScene(wall), *box);
    CHECK(seen.inside == 157.0 * 119.0);
    const double all = (box->right - box->left) * (box->bottom - box->top);
    CHECK(std::abs(seen.inside + seen.outside - (all)) <= 0.002 * all);
}

TEST_CASE("ground beneath a level pinhole is boxed and counted as far as 80 degrees from its axis",
          "[labels]") {
    Observer observer;
    observer.horizontal_fov_deg = 60.0;
    observer.width = 320;
    observer.height = 240;
    // 40 m square, 2 m below the eye, which is above its middle.
    const std::vector<Eigen::Vector3d> corner = {
        {-20.0, -20.0, -2.0}, {20.0, -20.0, -2.0}, {20.0, 20.0, -2.0}, {-20.0, 20.0, -2.0}};
    const std::vector<std::array<std::uint32_t, 3>> triangle = {{0, 1, 2}, {0, 2, 3}};
    const std::vector<MaterialId> material(2, MaterialId{});
    FacetSet ground;
    append_facets(ground, corner, triangle, material, ObjectId{1});
    const auto box = projected_box(observer, ground, both);
    REQUIRE(box);
    // In focal lengths: a point 2 m below is v = 2 / ahead down the picture, u = east / ahead.
    const double focal = 160.0 / std::tan(std::numbers::pi / 6.0),
                 end = std::tan(80.0 * std::numbers::pi / 180.0);
    CHECK(box->left == Approx(160.0 - focal * end).epsilon(1e-6));
    CHECK(box->right == Approx(160.0 + focal * end).epsilon(1e-6));
    CHECK(box->top == Approx(120.0 + focal * 0.1).epsilon(1e-6));
    CHECK(box->bottom == Approx(120.0 + focal * end).epsilon(1e-6));
    // At v it is 10 v wide to either side, at most `end`.
    const double all = 10.0 * (end * end / 100.0 - 0.01) + 2.0 * end * (end - end / 10.0);
    const double inside = 2.0 * 160.0 / focal * (120.0 / focal - 0.1);
    const SeenAlone seen = seen_alone(observer, RayScene(ground), *box);
    CHECK(seen.inside == Approx(inside * focal * focal).epsilon(0.02));
    CHECK(seen.inside + seen.outside == Approx(all * focal * focal).epsilon(0.02));
}

TEST_CASE("a box across a panorama's seam spans the whole width") {
    Observer observer;
    observer.projection = Projection::panorama;
    observer.horizontal_fov_deg = 360.0;
    observer.width = 640;
    observer.height = 320;
    const FacetSet behind = square(-30.0, 1.0);
    const auto box = projected_box(observer, behind, both);
    REQUIRE(box);
    CHECK(std::abs(box->left - (0.0)) <= 1e-9);
    CHECK(std::abs(box->right - (640.0)) <= 1e-9);
    const FacetSet ahead = square(30.0, 1.0);
    const double half = std::atan(1.0 / 30.0) * 320.0 / std::numbers::pi;
    const auto plain = projected_box(observer, ahead, both);
    REQUIRE(plain);
    CHECK(std::abs(plain->left - (320.0 - half)) <= 1e-4);
    CHECK(std::abs(plain->right - (320.0 + half)) <= 1e-4);
}

}  // namespace
