#include "scenes/job/world/light_source.hpp"

#include <catch2/catch.hpp>

using namespace diurna;

namespace {

const Site jacksboro{36.32, -84.2, 300.0};
const std::vector<Band> visible{flat_band("0.4-0.7", 0.4, 0.7)};
const std::vector<Band> infrared{flat_band("3-5", 3.0, 5.0), flat_band("8-12", 8.0, 12.0)};

LightSource lights(Instant instant, const std::vector<Band>& bands) {
    return light_source(sun_position(jacksboro, instant), jacksboro, instant, bands);
}

}  // namespace

// Full moon 2026-01-03 10:03 UTC, new moon 2026-01-18 19:52 UTC (U.S. Naval Observatory, phases of
// the moon).
TEST_CASE("the full moon lights the night that the sun has left", "[scenes][moon]") {
    // Local midnight, 4.4 h before the moon is full: high in the south, as the sun is in summer.
    const Instant midnight = parse_instant("2026-01-03T05:40:00Z");
    const LightSource night = lights(midnight, visible);
    REQUIRE(night.moon);
    CHECK(night.place.elevation_deg > 75.0);
    CHECK(night.place.distance_au == 1.0);
    CHECK(lit_share(*night.moon) > 0.995);
    const LightSource noon = lights(parse_instant("2026-01-03T17:30:00Z"), visible);
    CHECK_FALSE(noon.moon);
    CHECK(noon.place.elevation_deg > 25.0);
    // Pictures of heat alone do not ask for it.
    CHECK_FALSE(lights(midnight, infrared).moon);
}

TEST_CASE("at new moon the night stays dark", "[scenes][moon][by_degenerate]") {
    const LightSource night = lights(parse_instant("2026-01-19T05:40:00Z"), visible);
    CHECK_FALSE(night.moon);
    CHECK(night.place.elevation_deg < 0.0);
}
