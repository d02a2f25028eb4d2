#include "materials/air/sight_line.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

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

TEST_CASE("the setting sun is where the almanacs say", "[materials][sight_line][by_events]") {
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

TEST_CASE("without air a line is straight", "[materials][sight_line][by_degenerate]") {
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
          "[materials][sight_line][by_comparison]") {
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

TEST_CASE("sight lines end at the ground, at the top of the air, or after their range",
          "[materials][sight_line]") {
    CHECK(sight_line(2.0, 180.0).range_km() == Approx(2.0));
    CHECK(sight_line(0.0, 0.0).range_km() == Approx(atmosphere_top_km));
    CHECK(sight_line(1.0, 80.0, 7.0).range_km() == Approx(7.0));
    CHECK(sight_line(0.0, 90.0, 5.0).size() == 1);
    CHECK(sight_line(0.0, 90.0, 0.0).size() == 0);
    // From the geometry of a sphere: the horizon of 10 km height is sqrt(h (2R + h)) away.
    const double to_horizon = std::sqrt(10.0 * (2.0 * earth_radius_km + 10.0));
    const double dip_deg =
        std::acos(earth_radius_km / (earth_radius_km + 10.0)) * 180.0 / 3.14159265358979;
    CHECK(sight_line(10.0, 90.0 + dip_deg + 1e-4).range_km() == Approx(to_horizon).epsilon(0.01));
    CHECK(meets_ground(10.0, 90.0 + dip_deg + 1e-4));
    CHECK_FALSE(meets_ground(10.0, 90.0 + dip_deg - 1e-4));
    CHECK(sight_line(10.0, 90.0 + dip_deg - 1e-4).range_km() > 2.0 * to_horizon);
    // From space: straight down through the whole air; past the earth: nothing.
    CHECK(sight_line(700.0, 180.0).range_km() == Approx(atmosphere_top_km));
    CHECK(sight_line(700.0, 0.0).size() == 0);
    CHECK(sight_line(700.0, 110.0).size() == 0);
    CHECK(sight_line(700.0, 180.0, 500.0).size() == 0);
    // Below the sea a finite path goes on, an endless one has arrived.
    CHECK(sight_line(0.05, 95.0, 2.0).range_km() == Approx(2.0));
    CHECK(sight_line(-0.4, 91.0, 1.0).range_km() == Approx(1.0));
    CHECK(sight_line(-0.4, 91.0).size() == 0);
}

TEST_CASE("heights along a sight line are those of a sphere", "[materials][sight_line]") {
    const double zenith = GENERATE(0.0, 60.0, 89.0, 90.0, 91.0, 120.0);
    const SightLine line = sight_line(3.0, zenith, 40.0);
    const double r = earth_radius_km + 3.0, mu = std::cos(zenith * 3.14159265358979 / 180.0);
    double s = 0.0, worst = 0.0, worst_between = 0.0;
    for (std::size_t i = 0; i < line.size(); ++i) {
        for (const double share : {0.0, 0.25, 0.5, 1.0}) {
            const double at = s + share * line.length_km[i];
            const double height = std::sqrt(r * r + at * at + 2.0 * r * at * mu) - earth_radius_km;
            const double found = share == 0.5 ? line.height_km[i] : line.height_within(i, share);
            double& error = share == 0.25 ? worst_between : worst;
            error = std::max(error, std::abs(height - found));
        }
        s += line.length_km[i];
    }
    CHECK(worst < 1e-9);
    CHECK(worst_between < 3e-8);  // the parabola through them
}

TEST_CASE("no segment lies across the top of the aerosol", "[materials][sight_line]") {
    // Rising from, falling through and turning below 2 km: the part below is as long as the chord.
    struct Ray {
        double height_km, zenith_deg;
    };
    for (const auto& [height, zenith] :
         {Ray{0.3, 40.0}, Ray{0.3, 88.0}, Ray{5.0, 130.0}, Ray{3.0, 91.2}}) {
        const SightLine line = sight_line(height, zenith);
        const double r = earth_radius_km + height, mu = std::cos(zenith * 3.14159265358979 / 180.0);
        double s = 0.0, closest = 1e9;
        for (std::size_t i = 0; i < line.size(); ++i) {
            s += line.length_km[i];
            const double end = std::sqrt(r * r + s * s + 2.0 * r * s * mu) - earth_radius_km;
            closest = std::min(closest, std::abs(end - aerosol_top_km));
        }
        CAPTURE(height, zenith);
        CHECK(closest < 1e-6);
    }
}

TEST_CASE("any sight line has few segments that add up to it", "[materials][sight_line][stress]") {
    std::mt19937 random(20260715);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::size_t most = 0;
    bool sound = true;
    for (int i = 0; i < 20000; ++i) {
        const double height = -0.4 + 120.0 * std::pow(unit(random), 3);
        // Half of them within a degree of level, where a line falls, turns and rises.
        const double zenith = i % 2 == 0 ? 180.0 * unit(random) : 89.0 + 2.0 * unit(random);
        const double range = i % 3 == 0 ? 1e9 : 500.0 * unit(random);
        CAPTURE(height, zenith, range);
        const SightLine line = sight_line(height, zenith, range);
        most = std::max(most, line.size());
        sound = sound && line.range_km() <= range * (1.0 + 1e-9);
        for (std::size_t k = 0; k < line.size(); ++k) {
            sound = sound && line.length_km[k] > 0.0 && line.height_km[k] > -0.6 &&
                    line.height_km[k] < atmosphere_top_km + 1e-6;
        }
    }
    CHECK(sound);
    CHECK(most < 300);
}

TEST_CASE("a chord is the sight line of that angle", "[materials][sight_line]") {
    // 10 km at 2° down from 1 km: the end's height by the law of cosines.
    const double range = 10.0, zenith = 92.0, from = 1.0;
    const double r = earth_radius_km + from;
    const double end =
        std::sqrt(r * r + range * range + 2.0 * r * range * std::cos(radians(zenith))) -
        earth_radius_km;
    const Band band = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    const BandModel summer{.profile = afgl_profile("MLS"), .aerosol = "rural"};
    const auto a = path_at_nodes(summer, chord(from, end, range, 200), band.node_um);
    const auto b = path_at_nodes(summer, sight_line(from, zenith, range), band.node_um);
    CHECK(band_mean_nodes(band, a.transmittance) ==
          Approx(band_mean_nodes(band, b.transmittance)).epsilon(5e-4));
    CHECK(band_sum_nodes(band, a.radiance) ==
          Approx(band_sum_nodes(band, b.radiance)).epsilon(2e-3));
}
