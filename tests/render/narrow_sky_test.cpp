#include "render/light/narrow_sky.hpp"

#include <catch2/catch.hpp>

using namespace diurna;

// The underside of a vehicle on a slope, or of a table: no share of the sky, whichever rays found.
TEST_CASE("a facet that faces down has a narrow sky of nothing", "[render][sky]") {
    SkyVector sky{};
    const float rays = GENERATE(0.0f, 0.01f);
    sky[0] = rays;
    const NarrowView view = narrow_view(sky, {0.0f, 0.0f, -1.0f});
    for (const float share : view) CHECK(share == 0.0f);
}
