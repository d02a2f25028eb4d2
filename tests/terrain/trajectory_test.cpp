#include "terrain/place/trajectory.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

using namespace diurna;

namespace {

double apart(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm(); }

/// Where a body's own right, forward and up point.
Eigen::Vector3d right(const Eigen::Quaterniond& q) { return q * Eigen::Vector3d::UnitX(); }
Eigen::Vector3d ahead(const Eigen::Quaterniond& q) { return q * Eigen::Vector3d::UnitY(); }

}  // namespace

TEST_CASE("a straight trajectory has constant speed", "[terrain][trajectory]") {
    const std::vector<Eigen::Vector3d> place = {{0, 0, 10}, {30, 40, 10}, {30, 40, 110}};
    const Trajectory way{.seconds = seconds_at_speed(place, 10.0), .place = place};
    CHECK(way.seconds == std::vector<double>{0.0, 5.0, 15.0});
    CHECK(apart(place_at(way, 2.5), {15, 20, 10}) < 1e-12);
    CHECK(apart(place_at(way, 5.0), place[1]) < 1e-12);
    CHECK(apart(place_at(way, 10.0), {30, 40, 60}) < 1e-12);
    // It waits at its ends.
    CHECK(apart(place_at(way, -3.0), place.front()) == 0.0);
    CHECK(apart(place_at(way, 99.0), place.back()) < 1e-12);
}

TEST_CASE("a smooth trajectory follows a circle and passes through its points",
          "[terrain][trajectory]") {
    // Forty places on a circle of 100 m, h = 0.157 rad apart. The parabola's slope is off by h^2/6
    // of the third derivative, and the cubic by a fourth of that times h at most, where the two
    // ends' slopes are off to different sides: 100 h^3 / 24 = 0.016 m; straight ways by 100 h^2/8.
    Trajectory way;
    for (int i = 0; i <= 40; ++i) {
        const double angle = i * 2.0 * std::numbers::pi / 40.0;
        way.seconds.push_back(double(i));
        way.place.emplace_back(100.0 * std::cos(angle), 100.0 * std::sin(angle), 5.0);
    }
    const auto off = [&] {
        double worst = 0.0;
        for (double t = 3.0; t < 37.0; t += 0.01) {
            worst = std::max(worst, std::abs(place_at(way, t).head<2>().norm() - 100.0));
        }
        return worst;
    };
    CHECK(off() == Approx(0.308).epsilon(0.01));
    way.smooth = true;
    CHECK(off() < 0.02);
    CHECK(apart(place_at(way, 17.0), way.place[17]) < 1e-9);
    // Its velocity has no corners: before and behind a place it is the same.
    const double step = 1e-4;
    const Eigen::Vector3d before = (place_at(way, 17.0) - place_at(way, 17.0 - step)) / step;
    const Eigen::Vector3d after = (place_at(way, 17.0 + step) - place_at(way, 17.0)) / step;
    CHECK(apart(before, after) < 0.01 * before.norm());
}

TEST_CASE("a body's angles turn its right, front and top", "[terrain][trajectory]") {
    // Heading east, level: its right is south.
    const Eigen::Quaterniond east = attitude(90.0, 0.0, 0.0);
    CHECK(apart(ahead(east), {1, 0, 0}) < 1e-12);
    CHECK(apart(right(east), {0, -1, 0}) < 1e-12);
    // Nose 30 degrees up, then its right wing 90 degrees down.
    const Eigen::Quaterniond up = attitude(90.0, 30.0, 90.0);
    const double root = std::sqrt(0.75);
    CHECK(apart(ahead(up), {root, 0, 0.5}) < 1e-12);
    CHECK(apart(right(up), {0.5, 0, -root}) < 1e-12);
    // Along a velocity it has no roll.
    const Eigen::Quaterniond along = attitude_along({3.0, 3.0, -3.0});
    CHECK(apart(ahead(along), Eigen::Vector3d(1, 1, -1).normalized()) < 1e-12);
    CHECK(std::abs(right(along).z()) < 1e-12);
}

TEST_CASE("between two attitudes a body turns at an even rate", "[terrain][trajectory]") {
    const Trajectory way{.seconds = {0.0, 10.0},
                         .place = {{0, 0, 0}, {0, 0, 0}},
                         .attitude = {attitude(350.0, 0.0, 0.0), attitude(30.0, 0.0, 0.0)}};
    for (const double t : {2.5, 5.0, 7.5}) {
        const double heading = (350.0 + 4.0 * t) * std::numbers::pi / 180.0;  // over north
        CHECK(apart(ahead(attitude_at(way, t)), {std::sin(heading), std::cos(heading), 0}) < 1e-12);
    }
}

TEST_CASE("a smooth trajectory is at rest where it stops", "[terrain][trajectory]") {
    // North at 10 m/s, ten minutes' stop at 100 m, on to the east.
    const Trajectory way{
        .seconds = {0.0, 5.0, 10.0, 610.0, 615.0, 620.0},
        .place = {{0, 0, 0}, {0, 50, 0}, {0, 100, 0}, {0, 100, 0}, {50, 100, 0}, {100, 100, 0}},
        .attitude = {},
        .smooth = true};
    for (double t = 10.0; t <= 610.0; t += 7.5) {
        CHECK(apart(place_at(way, t), {0, 100, 0}) < 1e-9);
    }
    // It comes to a stop and never goes back on its way.
    for (double t = 0.0; t < 9.85; t += 0.1) {
        CHECK(place_at(way, t + 0.1).y() > place_at(way, t).y());
        CHECK(place_at(way, t).y() < 100.0);
    }
    CHECK((place_at(way, 10.0) - place_at(way, 9.999)).norm() < 1e-4);
    const std::vector<Rest> all = rests(way);
    REQUIRE(all.size() == 3);
    CHECK(all[1].from == 10.0);
    CHECK(all[1].until == 610.0);
}

TEST_CASE("a smooth trajectory has the requested speed", "[terrain][trajectory]") {
    const std::vector<Eigen::Vector3d> place = {
        {0, 0, 20}, {100, 0, 20}, {100, 80, 30}, {40, 160, 30}, {-60, 150, 20}};
    const Trajectory way = smooth_at_speed(place, 10.0);
    double length = 0.0;
    for (double t = 0.0; t + 0.05 < way.end(); t += 0.05) {
        const double step = apart(place_at(way, t), place_at(way, t + 0.05));
        CHECK(step == Approx(0.5).epsilon(0.01));
        length += step;
    }
    CHECK(way.end() == Approx(length / 10.0).epsilon(2e-3));
    for (const Eigen::Vector3d& there : place) {
        const bool passes = std::any_of(way.place.begin(), way.place.end(),
                                        [&](const auto& at) { return apart(at, there) < 1e-9; });
        CHECK(passes);
    }
}

TEST_CASE("a log in degrees moves, though its steps are small numbers", "[terrain][trajectory]") {
    // A metre or two a second at 36 degrees north, then a stop of two seconds.
    const Trajectory way{.seconds = {0.0, 1.0, 2.0, 4.0},
                         .place = {{-84.2, 36.3, 0.0},
                                   {-84.2, 36.30001, 0.0},
                                   {-84.2, 36.30003, 0.0},
                                   {-84.2, 36.30003, 0.0}}};
    const std::vector<Rest> all = rests(way, 111e3);
    REQUIRE(all.size() == 2);
    CHECK(all[0].until == 0.0);
    CHECK(all[1].from == 2.0);
}
