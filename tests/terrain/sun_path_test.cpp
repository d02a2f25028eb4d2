#include "terrain/place/sun_path.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/units.hpp"

using namespace diurna;

TEST_CASE("between computed places the sun moves smoothly", "[thermal][sun_path]") {
    const Site site{.latitude_deg = 46.8, .longitude_deg = 9.8, .height = 2540.0};
    for (const char* start : {"2026-06-21T00:00:00Z", "1968-12-30T17:03:00Z"}) {
        SunPath path(site);
        double worst = 0.0, farthest = 0.0;
        for (int i = 0; i < 600; ++i) {
            const Instant when = later(parse_instant(start), 151.7 * i);
            const SunPosition exact = sun_position(site, when), found = path.at(when);
            const double cosine = sun_direction(exact).cross(sun_direction(found)).norm();
            worst = std::max(worst, degrees(cosine) * 3600.0);
            farthest = std::max(farthest, std::abs(exact.distance_au - found.distance_au));
        }
        CAPTURE(start);
        CHECK(worst < 0.1);  // ″
        CHECK(farthest < 1e-7);
    }
}
