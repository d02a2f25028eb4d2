#include "materials/atmosphere/sun_field.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/solar_spectrum.hpp"
#include "materials/base/error.hpp"
#include "materials/radiation/planck.hpp"
#include "tests/support/lowtran_sun.hpp"
#include "tests/support/shared_data.hpp"

using namespace diurna;

namespace {

BandModel model(const std::string& profile, const std::string& aerosol = "none",
                double visibility_km = 23.0) {
    return {.profile = afgl_profile(profile), .aerosol = aerosol, .visibility_km = visibility_km};
}
Band band(double from, double to) { return flat_band("", from, to, bin_edges_um()); }

}  // namespace

TEST_CASE("scattered sunlight agrees with LOWTRAN7 to 20 %, without bias",
          "[materials][scattering][reference][by_comparison]") {
    const auto folder = shared_data("data/atmosphere/lowtran7");
    if (!folder) return;
    for (const char* kind : {"skysolar", "pathsolar"}) {
        const auto errors = lowtran::compare_sun(
            *folder, kind, {{"0.4-0.7", 0.4, 0.7}, {"0.7-1.0", 0.7, 1.0}, {"1.5-1.8", 1.5, 1.8}});
        for (const auto& [name, error] : errors) {
            fmt::print(
                "  {:>9} {:>8} um  {:3d} lines  mean {:5.2f} %  bias {:+6.2f} %  worst {:.1f} %\n",
                kind, name, error.count, error.mean(), error.bias(), error.worst);
            CAPTURE(kind, name);
            CHECK(error.mean() < 20.0);
            if (name != "1.5-1.8") CHECK(std::abs(error.bias()) < 10.0);
        }
    }
}

TEST_CASE("blue sky: thin air scatters as Rayleigh says",
          "[materials][scattering][by_comparison]") {
    // High up the air is thin enough for one scattering: L = E m / 4 (3/4)(1 + cos²) Δτ / π with
    // the whole vertical Rayleigh depth above 20 km. The ground's light adds under 40 % of albedo;
    // so black ground, and red light, of which little is scattered more than once.
    const BandModel air = model("US76");
    const Band red = band(0.85, 0.9);
    const SunField field(air, {.zenith_deg = 60.0, .ground_albedo = 0.0}, red.node_um);
    const double seen = band_sum_nodes(red, field.sky(20.0, 0.0, 0.0));
    const SunFlux flux = field.flux(20.0);
    double expected = 0.0;
    const SightLine up = line_of(air, 20.0, 0.0);
    const PathSpectrum path = path_at_nodes(air, up, red.node_um);
    for (std::size_t i = 0; i < red.node_um.size(); ++i) {
        // Depth from the published vertical one, 0.00877 λ^-4.05 (Bodhaine), times p(20 km) / p(0).
        const double depth = 0.00877 * std::pow(red.node_um[i], -4.05) * 55.29 / 1013.25;
        expected += red.weight[i] * flux.direct[i] * 0.75 * 1.25 * depth / (4.0 * std::numbers::pi);
    }
    CHECK(seen == Approx(expected).epsilon(0.05));
    CHECK(path.transmittance[0] > 0.99);
}

TEST_CASE("no light comes of a sun below the horizon, more of a higher one",
          "[materials][scattering][by_degenerate]") {
    const BandModel air = model("MLS", "rural");
    const Band in = band(0.5, 0.6);
    const auto fall = [&](double zenith) {
        const SunField field(air, {.zenith_deg = zenith}, in.node_um);
        return band_sum_nodes(in, field.flux(0.0).down);
    };
    CHECK(fall(120.0) == 0.0);
    CHECK(fall(30.0) > fall(60.0));
    CHECK(fall(60.0) > fall(85.0));
    CHECK(fall(85.0) > 0.0);
}

TEST_CASE("the sky's fluxes are those of its radiances", "[materials][scattering]") {
    // 0.4-0.7 um, by Gauss-Legendre in cos² and 12 azimuths; two streams against the sum of lines.
    const BandModel air = model("US76", "rural");
    const Band in = band(0.4, 0.7);
    for (const double zenith : {30.0, 60.0}) {
        const SunField field(air, {.zenith_deg = zenith}, in.node_um);
        double flux = 0.0;
        constexpr int rings = 24, azimuths = 24;
        for (int r = 0; r < rings; ++r) {
            const double view = degrees(std::acos(std::sqrt((r + 0.5) / rings)));
            for (int a = 0; a < azimuths; ++a) {
                flux += std::numbers::pi / (rings * azimuths) *
                        band_sum_nodes(in, field.sky(0.0, view, 180.0 * (a + 0.5) / azimuths));
            }
        }
        const double streams = band_sum_nodes(in, field.flux(0.0).down);
        fmt::print("  diffuse 0.4-0.7 um, sun {:g}: lines {:.1f}, streams {:.1f} W m-2\n", zenith,
                   flux, streams);
        CAPTURE(zenith);
        CHECK(flux == Approx(streams).epsilon(0.15));
    }
}

TEST_CASE("no more light reaches the ground than came", "[materials][scattering][energy]") {
    const Band in = band(0.36, 4.9);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const std::vector<std::string> kinds = aerosol_names();
    double above = 0.0;
    for (std::size_t i = 0; i < in.node_um.size(); ++i) {
        above += in.weight[i] * solar_above_air(in.node_um[i]);
    }
    for (int i = 0; i < 12; ++i) {
        BandModel air = model(afgl_profile_names()[std::size_t(i) % 6],
                              kinds[std::size_t(i) % kinds.size()], 1.0 + 50.0 * unit(random));
        if (i % 3 == 0)
            air.cloud = {.fraction = unit(random), .optical_depth = 30.0 * unit(random)};
        if (i % 4 == 0) air.rain_mm_h = 5.0;
        const double zenith = 88.0 * unit(random), albedo = unit(random);
        const SunField field(air, {.zenith_deg = zenith, .ground_albedo = albedo}, in.node_um);
        const SunFlux flux = field.flux(0.0);
        const double mu = std::cos(radians(zenith));
        const double down = band_sum_nodes(in, flux.down) + mu * band_sum_nodes(in, flux.direct);
        const double up = band_sum_nodes(in, flux.up);
        CAPTURE(i, air.aerosol, air.visibility_km, zenith, albedo, air.cloud.fraction);
        CHECK(down * (1.0 - albedo) <= above * mu);
        CHECK(down > 0.0);
        // What goes up from the ground is its albedo of what came down.
        CHECK(up == Approx(albedo * down).epsilon(0.02));
        const SunFlux top = field.flux(99.0);
        CHECK(band_sum_nodes(in, top.up) <= above * mu);
    }
}

TEST_CASE("an overcast hides the sun and spreads some of it", "[materials][scattering]") {
    const Band in = band(0.4, 0.7);
    BandModel air = model("MLS", "rural");
    const SunLight noon{.zenith_deg = 30.0};
    const SunFlux clear = SunField(air, noon, in.node_um).flux(0.0);
    air.cloud = {.fraction = 1.0, .base_km = 2.0, .optical_depth = 20.0};
    const SunField field(air, noon, in.node_um);
    const SunFlux covered = field.flux(0.0);
    CHECK(band_sum_nodes(in, covered.direct) < 1e-6);
    const double mu = std::cos(radians(30.0));
    const double total = band_sum_nodes(in, clear.direct) * mu + band_sum_nodes(in, clear.down);
    // Stephens 1978: a cloud of depth 20 passes 35 to 50 % of a high sun.
    const double share = band_sum_nodes(in, covered.down) / total;
    CHECK(share > 0.30);
    CHECK(share < 0.55);
    // Half covered is half of each.
    air.cloud.fraction = 0.5;
    const SunFlux half = SunField(air, noon, in.node_um).flux(0.0);
    CHECK(band_sum_nodes(in, half.down) ==
          Approx(0.5 * (band_sum_nodes(in, clear.down) + band_sum_nodes(in, covered.down))));
    // The standard overcast sky (Moon & Spencer): zenith 9/7 of what an even sky has, a third of
    // that at the horizon, less what the air between does; at 60 degrees two thirds.
    const double zenith_sky = band_sum_nodes(in, field.sky(0.0, 0.0, 90.0));
    CHECK(std::numbers::pi * zenith_sky ==
          Approx(9.0 / 7.0 * band_sum_nodes(in, covered.down)).epsilon(0.06));
    CHECK(band_sum_nodes(in, field.sky(0.0, 60.0, 90.0)) ==
          Approx(0.667 * zenith_sky).epsilon(0.1));
}

TEST_CASE("scattered light is never negative or NaN",
          "[materials][scattering][stress][by_extreme]") {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const std::vector<std::string> kinds = aerosol_names();
    const std::vector<double> node = {0.36, 0.55, 0.94, 1.38, 2.7, 4.26};
    for (int i = 0; i < 60; ++i) {
        BandModel air = model(afgl_profile_names()[std::size_t(i) % 6],
                              kinds[std::size_t(i) % kinds.size()], 0.3 + 60.0 * unit(random));
        air.ground_km = i % 5 == 0 ? 1.5 : 0.0;
        air.rain_mm_h = i % 7 == 0 ? 20.0 : 0.0;
        if (i % 3 == 0) air.cloud = {.fraction = unit(random), .base_km = 4.0 * unit(random)};
        const SunField field(air, {.zenith_deg = 100.0 * unit(random)}, node);
        for (int k = 0; k < 10; ++k) {
            const double height = 12.0 * std::pow(unit(random), 3), zenith = 180.0 * unit(random);
            const double azimuth = 360.0 * unit(random);
            const auto sky = field.sky(height, zenith, azimuth);
            const auto path =
                field.path(sight_line(height, zenith, 30.0 * unit(random)), zenith, azimuth);
            const SunFlux flux = field.flux(height);
            for (std::size_t n = 0; n < node.size(); ++n) {
                const bool sound = sky[n] >= 0.0 && path[n] >= 0.0 && flux.down[n] >= 0.0 &&
                                   flux.up[n] >= 0.0 && flux.direct[n] >= 0.0 && sky[n] < 1e6 &&
                                   path[n] < 1e6;
                if (!sound) {
                    FAIL("case " << i << " height " << height << " zenith " << zenith << " node "
                                 << node[n] << ": " << sky[n] << ' ' << path[n] << ' '
                                 << flux.down[n] << ' ' << flux.up[n]);
                }
            }
        }
    }
}

TEST_CASE("some nodes alone are the same as all, in any thread", "[materials][scattering]") {
    const BandModel air = model("MLS", "maritime");
    const Band few = band(0.55, 0.6);
    const std::vector<double> all(bin_middles_um().begin(), bin_middles_um().end());
    const SunField a(air, {.zenith_deg = 40.0}, few.node_um), b(air, {.zenith_deg = 40.0}, all);
    const auto x = a.sky(0.0, 50.0, 70.0), y = b.sky(0.0, 50.0, 70.0);
    for (std::size_t i = 0; i < few.node_um.size(); ++i) {
        CHECK(x[i] == Approx(y[bin_of(few.node_um[i])]).epsilon(1e-12));
    }
}

TEST_CASE("the sky of subarctic summer has REPTRAN's radiance",
          "[materials][scattering][flux][by_comparison]") {
    // libRadtran with REPTRAN, fine: down-welling irradiance without aerosol, 330 ppm [W m-2].
    BandModel air = model("SAS");
    air.co2_ppm = 330.0;
    struct Part {
        double from_um, to_um, expected, within;
    };
    for (const auto& [from, to, expected, within] :
         {Part{8, 14, 61.55, 0.03}, Part{8, 12, 32.50, 0.03}, Part{5, 8, 40.88, 0.02},
          Part{1e4 / 700, 1e4 / 500, 81.77, 0.02}}) {
        const Band in = band(from, to);
        double flux = 0.0;
        constexpr int rings = 16;
        for (int r = 0; r < rings; ++r) {
            const double zenith = degrees(std::acos(std::sqrt((r + 0.5) / rings)));
            flux += std::numbers::pi / rings *
                    band_sum_nodes(in, sky_at_nodes(air, 0.0, zenith, in.node_um));
        }
        fmt::print("  SAS {:5.2f}-{:5.2f} um: {:.2f}, REPTRAN {:.2f} W m-2, {:+.1f} %\n", from, to,
                   flux, expected, 100.0 * (flux / expected - 1.0));
        CHECK(flux == Approx(expected).epsilon(within));
    }
}
