#include "materials/air/sight_line.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/base/units.hpp"

using namespace diurna;

namespace {

/// Zenith angle [deg] at the end of a line and the angle at the earth's centre it spans, from its
/// segments alone: each climbs from one height to the next over its length.
struct End {
    double height_km, central_deg;
};
End end_of(const SightLine& line, double height_km, double zenith_deg, const Profile& profile) {
    // Bouguer: sin z = n0 r0 sin z0 / (n r); the angle at the centre is ∫ sin z / r ds.
    const double constant = (1.0 + refractivity(profile, height_km)) *
                            (earth_radius_km + height_km) * std::sin(radians(zenith_deg));
    double angle = 0.0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const double z = line.height_km[i], r = earth_radius_km + z;
        angle += constant / ((1.0 + refractivity(profile, z)) * r * r) * line.length_km[i];
    }
    return {0.0, degrees(angle)};
}

}  // namespace

TEST_CASE("the setting sun stands where the almanacs say", "[materials][sight_line]") {
    // Refraction R = z0 + angle at the centre - true zenith angle; far above the air the ray is
    // straight, so R = z0 + angle - z(top). Bennett's formula (1982, 0.07' of observations at
    // 1010 hPa, 10 C) is 0.98' at 45 degrees, 5.3' at 80, 9.9' at 85, 18.2' at 88.
    Profile air = afgl_profile("US76");
    const double here = 77.6e-6 * air.pressure_hPa[0] / air.temperature[0];
    for (const double altitude : {45.0, 10.0, 5.0, 2.0, 0.0}) {  // 34.5' on the horizon
        const double zenith = 90.0 - altitude;
        const SightLine line =
            refracted_line(air, 0.0, zenith, std::numeric_limits<double>::infinity(),
                           {.first_km = 0.002, .growth = 0.05, .ceiling_km = 0.05});
        const double central = end_of(line, 0.0, zenith, air).central_deg;
        const double top = earth_radius_km + atmosphere_top_km;
        const double at_top =
            degrees(std::asin((1.0 + here) * earth_radius_km * std::sin(radians(zenith)) / top));
        const double found = 60.0 * (at_top + central - zenith);
        // Bennett is for visible light, 1010 hPa, 10 C; scaled to this air and to (n-1) of 77.6.
        const double bennett = 1.0 / std::tan(radians(altitude + 7.31 / (altitude + 4.4))) *
                               (77.6 / 79.0) * (1013.25 / 1010.0) * (283.15 / air.temperature[0]);
        CAPTURE(altitude, line.size());
        // On the horizon the lowest air's lapse rate decides.
        CHECK(found == Approx(bennett).epsilon(altitude > 0.0 ? 0.02 : 0.03).margin(0.07));
    }
}

TEST_CASE("without air a line is straight", "[materials][sight_line]") {
    Profile thin = afgl_profile("US76");
    for (double& p : thin.pressure_hPa) p *= 1e-9;
    for (const double zenith : {0.0, 60.0, 89.0, 90.0, 91.0, 120.0, 180.0}) {
        const SightLine bent = refracted_line(thin, 3.0, zenith);
        const SightLine straight = sight_line(3.0, zenith);
        CAPTURE(zenith);
        CHECK(bent.range_km() == Approx(straight.range_km()).epsilon(1e-8));
        CHECK(meets_ground(thin, 3.0, zenith) == meets_ground(3.0, zenith));
    }
}

TEST_CASE("refraction lifts the horizon by a twelfth to a sixth of its dip",
          "[materials][sight_line]") {
    // Surveyors' coefficient k = 0.13 to 0.17 shrinks the dip by sqrt(1 - k).
    const Profile air = afgl_profile("US76");
    const double dip = degrees(std::acos(earth_radius_km / (earth_radius_km + 0.3)));
    CHECK(meets_ground(air, 0.3, 90.0 + dip * std::sqrt(1.0 - 0.12)));
    CHECK(meets_ground(air, 0.3, 90.0 + dip * std::sqrt(1.0 - 0.20)) == false);
    CHECK(meets_ground(air, 0.3, 90.0 + dip * 0.98));
    double low = 90.0, high = 90.0 + dip;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        (meets_ground(air, 0.3, middle) ? high : low) = middle;
    }
    const double k = 1.0 - std::pow((low - 90.0) / dip, 2);
    CHECK(k > 0.12);
    CHECK(k < 0.20);
}

TEST_CASE("a bent line ends on the ground exactly when the horizon says so",
          "[materials][sight_line]") {
    const Profile air = afgl_profile("MLS");
    for (const double height : {0.01, 0.3, 2.0, 9.0}) {
        double low = 90.0, high = 100.0;
        for (int i = 0; i < 50; ++i) {
            const double middle = 0.5 * (low + high);
            (meets_ground(air, height, middle) ? high : low) = middle;
        }
        CAPTURE(height, low);
        // Past the horizon it leaves through the top of the air; before it, it stops on the ground.
        CHECK(refracted_line(air, height, low - 0.01).height_km.back() > 90.0);
        CHECK(refracted_line(air, height, high + 0.01).height_km.back() < 0.1);
    }
}
