#include "materials/atmosphere/atmosphere.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

#include "materials/radiation/planck.hpp"

using namespace diurna;

namespace {

BandModel model(const std::string& profile, const std::string& aerosol = "none") {
    return {.profile = afgl_profile(profile), .aerosol = aerosol};
}

Band band(double from, double to) { return flat_band("", from, to, bin_edges_um()); }

}  // namespace

TEST_CASE("air and ground at one temperature look black, whatever the path",
          "[materials][atmosphere][furnace]") {
    const double kelvins = GENERATE(230.0, 300.0, 340.0);
    BandModel air = model("MLS", "rural");
    air.profile = isothermal(air.profile, kelvins);
    air.space_temperature = kelvins;
    for (const Band& in : {band(3, 5), band(8, 12), band(3.7, 4.7)}) {
        const double black = band_radiance(in, kelvins);
        for (const double zenith : {0.0, 75.0, 90.0, 95.0, 180.0}) {
            CAPTURE(kelvins, in.from_um(), zenith);
            const NodeSpectrum path = path_at_nodes(air, sight_line(1.0, zenith, 7.0), in.node_um);
            double seen = 0.0;
            for (std::size_t i = 0; i < in.node_um.size(); ++i) {
                seen += in.weight[i] *
                        (path.radiance[i] + path.transmittance[i] * planck(in.node_um[i], kelvins));
            }
            CHECK(seen == Approx(black).epsilon(1e-12));
            CHECK(band_sum_nodes(in, sky_at_nodes(air, 1.0, zenith, in.node_um)) ==
                  Approx(black).epsilon(1e-12));
        }
    }
}

TEST_CASE("the default sight line has path radiance to 0.2 %", "[materials][atmosphere][order]") {
    const Segmentation fine{
        .first_km = 0.0005, .growth = 0.02, .ceiling_km = 0.01, .thinning_km = 8.0};
    constexpr double no_end = std::numeric_limits<double>::infinity();
    const std::string profile = GENERATE("TROP", "MLS", "SAW", "US76");
    BandModel air = model(profile, "rural");
    struct Ray {
        double height_km, zenith_deg;
    };
    for (const auto& [height, zenith] : {Ray{0, 0}, Ray{0, 60}, Ray{0, 85}, Ray{1, 180},
                                         Ray{3, 120}, Ray{10, 180}, Ray{0.5, 93}}) {
        const SightLine usual = sight_line(height, zenith);
        const SightLine finest = sight_line(height, zenith, no_end, fine);
        CHECK(usual.size() < 120);
        CHECK(usual.range_km() == Approx(finest.range_km()).epsilon(1e-12));
        for (const Band& in :
             {band(1.5, 1.8), band(3, 5), band(3.5, 4.1), band(8, 12), band(8, 14)}) {
            CAPTURE(profile, height, zenith, in.from_um());
            const NodeSpectrum a = path_at_nodes(air, usual, in.node_um);
            const NodeSpectrum b = path_at_nodes(air, finest, in.node_um);
            CHECK(band_sum_nodes(in, a.radiance) ==
                  Approx(band_sum_nodes(in, b.radiance)).epsilon(0.002));
            // Held to 0.1 %, or 3e-5 where the air is nearly opaque.
            CHECK(band_mean_nodes(in, a.transmittance) ==
                  Approx(band_mean_nodes(in, b.transmittance)).epsilon(0.001).margin(3e-5));
        }
    }
}

TEST_CASE("where the air is opaque one sees its own temperature", "[materials][atmosphere]") {
    // The middle of carbon dioxide's 4.26 um band, over 5 km of level air.
    const BandModel air = model("MLS");
    const std::vector<double> node = {4.26};
    const NodeSpectrum path = path_at_nodes(air, sight_line(0.0, 90.0, 5.0), node);
    CHECK(path.transmittance[0] < 1e-6);
    CHECK(path.radiance[0] == Approx(planck(4.26, air.profile.temperature.front())).epsilon(1e-3));
}

TEST_CASE("paths to each segment end in the path", "[materials][atmosphere]") {
    const BandModel air = model("US76", "maritime");
    const Band in = band(3, 5);
    const SightLine line = sight_line(2.0, 120.0);
    const std::vector<NodeSpectrum> paths = paths_at_nodes(air, line, in.node_um);
    const NodeSpectrum whole = path_at_nodes(air, line, in.node_um);
    REQUIRE(paths.size() == line.size());
    CHECK(paths.back().radiance == whole.radiance);
    CHECK(paths.back().transmittance == whole.transmittance);
}

TEST_CASE("a path cut short is the path to that segment", "[materials][atmosphere]") {
    // Without aerosol: its humidity is that of the lowest point of the whole line.
    const BandModel air = model("US76");
    const Band in = band(3, 5);
    SightLine line = sight_line(2.0, 120.0);
    const std::vector<NodeSpectrum> paths = paths_at_nodes(air, line, in.node_um);
    line.height_km.resize(5);
    line.length_km.resize(5);
    const NodeSpectrum cut = path_at_nodes(air, line, in.node_um);
    CHECK(cut.radiance == paths[4].radiance);
    CHECK(cut.transmittance == paths[4].transmittance);
}

TEST_CASE("a vacuum neither absorbs nor shines", "[materials][atmosphere]") {
    const Atmosphere none = Vacuum{.space_temperature = 4.0};
    const Band in = band(8, 12);
    const NodeSpectrum path = path_at_nodes(none, sight_line(0.0, 90.0, 100.0), in.node_um);
    CHECK(band_mean_nodes(in, path.transmittance) == Approx(1.0).epsilon(1e-14));
    CHECK(band_sum_nodes(in, path.radiance) == 0.0);
    CHECK(band_sum_nodes(in, sky_at_nodes(none, 0.0, 30.0, in.node_um)) ==
          Approx(band_radiance(in, 4.0)));
    CHECK(solar_at_nodes(none, 0.0, 30.0, 1.0, in.node_um)[0] == solar_above_air(in.node_um[0]));
}

TEST_CASE("the sun fades with the square of its distance and through the air",
          "[materials][atmosphere]") {
    const BandModel air = model("MLS", "rural");
    const Band in = band(0.4, 0.7);
    const auto sun = [&](double height, double zenith, double au) {
        return band_sum_nodes(in, solar_at_nodes(air, height, zenith, au, in.node_um));
    };
    CHECK(sun(0, 30, 1.02) == Approx(sun(0, 30, 1.0) / (1.02 * 1.02)).epsilon(1e-13));
    CHECK(sun(0, 60, 1.0) < sun(0, 0, 1.0));
    CHECK(sun(3, 60, 1.0) > sun(0, 60, 1.0));
    CHECK(sun(0, 90.5, 1.0) == 0.0);  // below the sea's horizon
    CHECK(sun(3, 90.5, 1.0) > 0.0);   // but not below that of a mountain, 1.76 degrees lower
    CHECK(sun(3, 92.0, 1.0) == 0.0);
    const NodeSpectrum path = path_at_nodes(air, line_of(air, 0, 45), in.node_um);
    CHECK(solar_at_nodes(air, 0, 45, 1.0, in.node_um)[9] ==
          Approx(path.transmittance[9] * solar_above_air(in.node_um[9])).epsilon(1e-13));
}

TEST_CASE("broadband sun of a clear day reaches the ground as measured",
          "[materials][atmosphere]") {
    // Direct normal irradiance of the ASTM G173 atmosphere at air mass 1.5 is 900 W/m2; here with
    // a US standard air and 23 km of visibility, direct beam alone, 0.35 to 20 um.
    const Band in = band(0.3, 19.99);
    const double direct =
        band_sum_nodes(in, solar_at_nodes(model("US76", "rural"), 0, 48.19, 1.0, in.node_um));
    CHECK(direct > 600.0);
    CHECK(direct < 900.0);
}

TEST_CASE("sight lines end at the ground, at the top of the air, or after their range",
          "[materials][atmosphere]") {
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

TEST_CASE("heights along a sight line are those of a sphere", "[materials][atmosphere]") {
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

TEST_CASE("no segment lies across the top of the aerosol", "[materials][atmosphere]") {
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

TEST_CASE("any sight line has few segments that add up to it", "[materials][atmosphere][stress]") {
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

TEST_CASE("bins and nodes of a band agree where the function is constant per bin",
          "[materials][atmosphere]") {
    const BandModel air = model("MLS");
    const SightLine line = sight_line(0, 90, 2);
    const Band in = band(8, 12);
    CHECK(band_mean(in, path_spectrum(air, line).transmittance) ==
          Approx(band_mean_nodes(in, path_at_nodes(air, line, in.node_um).transmittance))
              .epsilon(1e-13));
}
