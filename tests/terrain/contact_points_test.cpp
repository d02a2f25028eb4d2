#include "terrain/objects/contact_points.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "terrain/place/trajectory.hpp"

using namespace diurna;

namespace {

/// The corners of upright boxes of a half width and half length about places, from a bottom to a
/// top [m], z up.
struct Box {
    double east, north, half_width, half_length, bottom, top;
};
MeshFile boxes(const std::vector<Box>& all) {
    MeshFile mesh;
    for (const Box& box : all) {
        for (const double up : {box.bottom, box.top}) {
            for (const double x : {-1.0, 1.0}) {
                for (const double y : {-1.0, 1.0}) {
                    mesh.vertex.emplace_back(box.east + x * box.half_width,
                                             box.north + y * box.half_length, up);
                }
            }
        }
    }
    return mesh;
}

}  // namespace

TEST_CASE("a box touches level ground at its four lower corners", "[terrain][objects]") {
    const auto points = contact_points(boxes({{5.0, -3.0, 1.5, 3.0, 0.0, 2.0}}), {.up = UpAxis::z});
    REQUIRE(points.size() == 4);
    for (const auto& at : points) {
        CHECK(std::abs(at.x()) == Approx(1.5));
        CHECK(std::abs(at.y()) == Approx(3.0));
        CHECK(at.z() == 0.0);
    }
    CHECK(least_width(points) == Approx(3.0));
}

TEST_CASE("a vehicle touches the ground with its wheels, whatever its hull", "[terrain][objects]") {
    // A hull of 7 x 3 m, 0.5 m above the ground, on four blocks of 0.3 m.
    std::vector<Box> vehicle = {{0.0, 0.0, 1.5, 3.5, 0.5, 2.5}};
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-2.0, 2.0}) vehicle.push_back({x, y, 0.15, 0.15, 0.0, 0.6});
    }
    const double inches = GENERATE(1.0, 1.0 / 0.0254);
    MeshFile mesh = boxes(vehicle);
    for (auto& v : mesh.vertex) v *= inches;
    const auto points = contact_points(mesh, {.up = UpAxis::z, .metres = 1.0 / inches});
    REQUIRE(points.size() >= 4);
    for (const auto& at : points) {
        CHECK(std::abs(at.x()) <= 1.15 + 1e-9);
        CHECK(std::abs(at.y()) <= 2.15 + 1e-9);
        CHECK(at.z() == Approx(0.0).margin(1e-9));
    }
    CHECK(least_width(points) == Approx(2.3));
}

TEST_CASE("a mast of 10 m touches the ground with a foot of 0.3 m", "[terrain][objects]") {
    const auto points =
        contact_points(boxes({{0.0, 0.0, 0.15, 0.15, 0.0, 10.0}}), {.up = UpAxis::z});
    CHECK(least_width(points) == Approx(0.3));
}

TEST_CASE("a box on its roof touches level ground with its roof, on its side with its side",
          "[terrain][objects]") {
    const MeshFile mesh = boxes({{5.0, -3.0, 1.5, 3.0, 0.0, 2.0}});
    const double roll = GENERATE(90.0, 180.0);
    CAPTURE(roll);
    const Eigen::Matrix3d turn = attitude(40.0, 0.0, roll).toRotationMatrix();
    const auto points = contact_points(mesh, {.up = UpAxis::z}, turn);
    REQUIRE(points.size() == 4);
    for (const auto& at : points) {
        CHECK((turn * at).z() == Approx(roll == 180.0 ? -2.0 : -1.5));
    }
}
