#include "scenes/report/annotations.hpp"

#include <catch2/catch.hpp>
#include <numeric>

using namespace diurna;

TEST_CASE("masks hold box, area and COCO's column-wise runs", "[scenes][annotations]") {
    // Sky above, ground below; object 2 as an L of three pixels, object 5 in a corner.
    Frame frame;
    frame.width = 4;
    frame.height = 3;
    frame.planes = {{.name = "object",
                     .unit = "1",
                     .pixel = {-1, -1, -1, -1,  //
                               0, 2, 0, 0,      //
                               0, 2, 2, 5}}};
    const auto masks = object_masks(frame);
    REQUIRE(masks.size() == 2);
    CHECK(masks[0].object == 2);
    CHECK(masks[0].left == 1);
    CHECK(masks[0].top == 1);
    CHECK(masks[0].width == 2);
    CHECK(masks[0].height == 2);
    CHECK(masks[0].pixels == 3);
    CHECK(masks[0].runs == std::vector<std::uint32_t>{4, 2, 2, 1, 3});
    CHECK(masks[1].object == 5);
    CHECK(masks[1].runs == std::vector<std::uint32_t>{11, 1});
    for (const ObjectMask& mask : masks) {
        CHECK(std::accumulate(mask.runs.begin(), mask.runs.end(), 0u) == 12);
    }
}
