#include "thermal/weather/sky_spread.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"
#include "terrain/visibility/sky_basis.hpp"
#include "thermal/weather/sky_state.hpp"

using namespace diurna;

namespace {

/// A sky of 100 W/m² on level ground whose radiance is even except for `tilt` x, x towards the sun.
SkyState leaning_sky(double azimuth, double tilt) {
    SkySpread spread;
    spread.uneven[3] = static_cast<float>(tilt);  // c₄, of x
    const SkySpreads spreads{.instant = {Instant{}}, .spread = {spread}};
    SkyState sky;
    sky.to_sun = {0.5 * std::cos(azimuth), 0.5 * std::sin(azimuth), std::sqrt(0.75)};
    sky.diffuse_horizontal = 100.0;
    sky.split = spreads.at(Instant{}, sky.to_sun);
    return sky;
}

double on(const SkyState& sky, const Eigen::Vector3d& normal) {
    return facet_sunlight(sky, 0.0, 0.0, open_sky(open_plane(normal.cast<float>())));
}

}  // namespace

// Level ground takes nothing of x; a wall that faces it takes half of an even sky and, of x,
// ∫ x² dω over its quarter of the sphere = π / 3 (closed form), the wall behind as much less.
TEST_CASE("a sky that leans to the sun conserves level light and favours the wall that faces it",
          "[thermal][weather][sky]") {
    const double azimuth = GENERATE(0.0, 0.7, 2.5, 4.0), tilt = 0.06;
    const SkyState sky = leaning_sky(azimuth, tilt);
    CAPTURE(azimuth);
    CHECK(on(sky, Eigen::Vector3d::UnitZ()) == Approx(100.0).margin(0.02));
    const Eigen::Vector3d towards(std::cos(azimuth), std::sin(azimuth), 0.0);
    const double more = 100.0 * tilt * std::numbers::pi / 3.0;
    CHECK(on(sky, towards) == Approx(50.0 + more).margin(0.05));
    CHECK(on(sky, -towards) == Approx(50.0 - more).margin(0.05));
    CHECK(on(sky, {-towards.y(), towards.x(), 0.0}) == Approx(50.0).margin(0.05));
}
