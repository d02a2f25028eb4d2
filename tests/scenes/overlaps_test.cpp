#include "scenes/job/world/overlaps.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace diurna;

namespace {

/// Length 4, width 2, from the ground to 3 m.
BodyBox box_at(double east, double north, double turn_deg = 0.0) {
    const double turn = turn_deg * 0.017453292519943295;
    return {{east, north}, {std::cos(turn), std::sin(turn)}, 2.0, 1.0, 0.0, 3.0};
}

}  // namespace

// By hand: two boxes along east overlap by what their distance lacks of their length.
TEST_CASE("boxes that reach into one another are counted", "[scenes]") {
    const std::vector<BodyBox> row{box_at(0.0, 0.0), box_at(3.75, 0.0), box_at(7.75, 0.0),
                                   box_at(20.0, 0.0)};
    const Overlaps found = overlaps(row, 0.01);
    CHECK(found.pairs == 1);
    CHECK(found.worst.first == 0);
    CHECK(found.worst.second == 1);
    CHECK(found.deepest == Approx(0.25).epsilon(1e-12));
}

// The corner of a box turned by 45 degrees is (2 + 1)/√2 from its middle: it pierces the side of
// the other, 1 m from that one's middle, where the middles are nearer than the sum.
TEST_CASE("a corner that pierces a side is an overlap", "[scenes]") {
    const double reach = 3.0 / std::sqrt(2.0) + 1.0;
    const auto apart = [&](double north) {
        return overlaps(std::vector{box_at(0.0, 0.0), box_at(0.0, north, 45.0)}, 0.0);
    };
    CHECK(apart(reach + 0.01).pairs == 0);
    REQUIRE(apart(reach - 0.01).pairs == 1);
    CHECK(apart(reach - 0.01).deepest == Approx(0.01).epsilon(1e-6));
}

// One above the other, as on a shelf.
TEST_CASE("an object above another is clear of it", "[scenes]") {
    BodyBox above = box_at(0.0, 0.0);
    above.bottom = 3.0;
    above.top = 6.0;
    CHECK(overlaps(std::vector{box_at(0.0, 0.0), above}, 0.01).pairs == 0);
}
