#include "materials/atmosphere/atmosphere.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "materials/atmosphere/solar_spectrum.hpp"
#include "materials/radiation/planck.hpp"
#include "tests/support/isothermal.hpp"

using namespace diurna;

namespace {

BandModel model(const std::string& profile, const std::string& aerosol = "none") {
    return {.profile = afgl_profile(profile), .aerosol = aerosol};
}

Band band(double from, double to) { return flat_band("", from, to, bin_edges_um()); }

}  // namespace

TEST_CASE("air and ground at one temperature look black, whatever the path",
          "[materials][atmosphere][furnace][by_degenerate]") {
    const double kelvins = GENERATE(230.0, 300.0, 340.0);
    BandModel air = model("MLS", "rural");
    air.profile = isothermal(air.profile, kelvins);
    air.space_temperature = kelvins;
    for (const Band& in : {band(3, 5), band(8, 12), band(3.7, 4.7)}) {
        const double black = band_radiance(in, kelvins);
        for (const double zenith : {0.0, 75.0, 90.0, 95.0, 180.0}) {
            CAPTURE(kelvins, in.from_um(), zenith);
            const PathSpectrum path = path_at_nodes(air, sight_line(1.0, zenith, 7.0), in.node_um);
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
            const PathSpectrum a = path_at_nodes(air, usual, in.node_um);
            const PathSpectrum b = path_at_nodes(air, finest, in.node_um);
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
    const PathSpectrum path = path_at_nodes(air, sight_line(0.0, 90.0, 5.0), node);
    CHECK(path.transmittance[0] < 1e-6);
    CHECK(path.radiance[0] == Approx(planck(4.26, air.profile.temperature.front())).epsilon(1e-3));
}

TEST_CASE("a vacuum neither absorbs nor emits", "[materials][atmosphere][by_degenerate]") {
    const Atmosphere none = Vacuum{.space_temperature = 4.0};
    const Band in = band(8, 12);
    const PathSpectrum path = path_at_nodes(none, sight_line(0.0, 90.0, 100.0), in.node_um);
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
    const PathSpectrum path = path_at_nodes(air, line_of(air, 0, 45), in.node_um);
    CHECK(solar_at_nodes(air, 0, 45, 1.0, in.node_um)[9] ==
          Approx(path.transmittance[9] * solar_above_air(in.node_um[9])).epsilon(1e-13));
}

TEST_CASE("broadband sun of a clear day reaches the ground as measured",
          "[materials][atmosphere][by_history]") {
    // Direct normal irradiance of the ASTM G173 atmosphere at air mass 1.5 is 900 W/m2; here with
    // a US standard air and 23 km of visibility, direct beam alone, 0.35 to 20 um.
    const Band in = band(0.3, 19.99);
    const double direct =
        band_sum_nodes(in, solar_at_nodes(model("US76", "rural"), 0, 48.19, 1.0, in.node_um));
    CHECK(direct > 600.0);
    CHECK(direct < 900.0);
}
