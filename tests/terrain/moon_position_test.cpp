#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/units.hpp"
#include "terrain/place/celestial.hpp"
#include "terrain/place/moon.hpp"
#include "terrain/place/sun.hpp"

using namespace diurna;

namespace {

// Meeus, Astronomical Algorithms (1998), examples 47.a and 48.a: 1992 April 12, 0h dynamical time,
// which is 58.184 s ahead of UTC (26 leap seconds).
const Instant example = parse_instant("1992-04-11T23:59:01.816Z");

}  // namespace

TEST_CASE("the moon is where Meeus's example 47.a has it", "[terrain][moon][by_comparison]") {
    const Eigen::Vector3d moon = moon_from_earth(example);
    CHECK(moon.norm() * 149597870.7 == Approx(368409.7).margin(5.0));
    // Declination of date: the frame's axis is the earth's.
    CHECK(degrees(std::asin(moon.z() / moon.norm())) == Approx(13.768368).margin(0.001));
    // Right ascension 134.688470° less Greenwich's sidereal time: the mean one after formula 12.4,
    // its nutation Δψ cos ε = 16.595″ cos 23.44°.
    const double days = seconds_between(parse_instant("2000-01-01T12:00:00Z"), example) / 86400.0;
    const double sidereal_deg = 280.46061837 + 360.98564736629 * days + 16.595 / 3600.0 * 0.9175;
    const double east_deg = degrees(std::atan2(moon.y(), moon.x()));
    // UT1 taken as UTC: 0.3 s of turning then, 0.0012°.
    CHECK(std::remainder(134.688470 - sidereal_deg - east_deg, 360.0) == Approx(0).margin(0.0025));
}

TEST_CASE("the moon is lit as in Meeus's example 48.a",
          "[terrain][moon][by_events][by_comparison]") {
    const MoonLight light =
        moon_light(moon_from_earth(example), sun_from_earth(example), Eigen::Vector3d::Zero());
    CHECK(light.phase_deg == Approx(69.0756).margin(0.005));
    CHECK(lit_share(light) == Approx(0.6786).margin(0.0001));
    CHECK(light.distance_km == Approx(368409.7).margin(5.0));
    CHECK(light.sun_distance_au ==
          Approx(1.0025 - 0.00246 * std::cos(radians(110.79))).margin(5e-5));  // elongation 110.79°
}

TEST_CASE("from the ground the moon is nearer overhead and lower at the horizon",
          "[terrain][moon]") {
    // Parallax: a moon overhead is nearer by the earth's radius, one at the horizon stands lower by
    // asin(radius / distance), 0.9 to 1.03°.
    const Eigen::Vector3d moon = moon_from_earth(example);
    const double radius_km = 6378.0, distance_km = moon.norm() * 149597870.7;
    const double latitude_deg = degrees(std::asin(moon.z() / moon.norm()));
    const double longitude_deg = degrees(std::atan2(moon.y(), moon.x()));
    const MoonPosition above = moon_position({latitude_deg, longitude_deg, 0.0}, example);
    CHECK(above.elevation_deg > 89.9);
    CHECK(above.light.distance_km == Approx(distance_km - radius_km).margin(30.0));
    // A quarter round the equator from the moon's meridian it stands at the horizon, except for
    // that.
    const MoonPosition aside = moon_position({0.0, longitude_deg + 90.0, 0.0}, example);
    CHECK(aside.elevation_deg == Approx(-degrees(std::asin(radius_km / distance_km))).margin(0.01));
    CHECK(aside.azimuth_deg == Approx(270.0 + latitude_deg).margin(0.3));
}
