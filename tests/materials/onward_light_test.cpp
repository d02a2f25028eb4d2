#include "materials/atmosphere/onward_light.hpp"

#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "materials/atmosphere/sun_field.hpp"
#include "materials/base/quadrature.hpp"
#include "materials/base/units.hpp"
#include "tests/support/reflected_sun.hpp"

using namespace diurna;

namespace {

double sum_of(const Band& band, const std::vector<double>& light,
              const std::vector<double>& share) {
    double sum = 0.0;
    for (std::size_t n = 0; n < light.size(); ++n) sum += band.weight[n] * light[n] * share[n];
    return sum;
}

}  // namespace

// The product of both ways' transmittances is 3 to 7 % below in 0.7-1.0 and 1.5-1.8 µm.
TEST_CASE("sunlight reflected by the ground is LOWTRAN7's to 2 %, one path for the gases",
          "[materials][onward][by_comparison]") {
    for (std::size_t b = 0; b < 3; ++b) {
        const Band band = lowtran::ranges[b].band();
        const auto [errors, product] = lowtran::compare_reflected_sun(band, b);
        fmt::print(
            "  {:>8} um  one path: mean {:.2f} %  bias {:+.2f} %  worst {:.1f} %;  product: "
            "bias {:+.2f} %\n",
            band.name, errors.mean(), errors.bias(), errors.worst, product.bias());
        CAPTURE(band.name);
        CHECK(errors.mean() < 2.0);
    }
}

// One gas, one wavelength, the same way down and up: W doubles, so that −ln τ grows 2^a-fold,
// between 2^0.4 and 2 for every gas of the model; with more ways it is as if both were one line.
TEST_CASE("a path and the same path back are one of twice the amounts", "[materials][onward]") {
    BandModel air{.profile = afgl_profile("MLS"), .refraction = false};
    const Band band = flat_band("", 3.0, 5.0, bin_edges_um());
    const SightLine down = sight_line(100.0, 180.0);
    const auto way = OnwardLight(Atmosphere{air}, 0.0, 0.0, band.node_um).way(down);
    const std::vector<double> twice =
        path_at_nodes(Atmosphere{air}, joined(down, sight_line(0.0, 0.0)), band.node_um)
            .transmittance;
    for (std::size_t n = 0; n < band.node_um.size(); ++n) {
        const double once = -std::log(way.path.transmittance[n]);
        if (once > 20.0) continue;
        CAPTURE(band.node_um[n], once);
        CHECK(-std::log(way.sunlight[n]) <= once * (1.0 + 2e-3) + 1e-5);
        CHECK(-std::log(way.sunlight[n]) >= once * (std::pow(2.0, 0.4) - 1.0) * (1.0 - 2e-3));
        CHECK(way.path.transmittance[n] * way.sunlight[n] ==
              Approx(twice[n]).epsilon(2e-3).margin(1e-8));
    }
}

// Both ways as one line, node by node: the mean sky under eight zenith angles; sunlight on level
// ground, scattered light summed over lines of four zenith angles and four azimuths. No haze, whose
// forward peak counts as not scattered. Light that clouds scatter has no path; they only dim here.
TEST_CASE("what gets through is the joined path's, to 1.5 % everywhere", "[materials][onward]") {
    const std::string profile = GENERATE("TROP", "SAW");
    const double sun_zenith_deg = GENERATE(25.0, 75.0);
    const BandModel clear{.profile = afgl_profile(profile)};
    BandModel model = clear;
    model.cloud.fraction = GENERATE(0.0, 0.6);
    const Atmosphere air = model, clear_air = clear;
    const double up = std::cos(radians(sun_zenith_deg)) * std::numbers::inv_pi;
    double worst_sun = 0.0, worst_heat = 0.0;
    for (const auto& [from, to] :
         {std::array{0.7, 1.0}, {1.5, 1.8}, {3.0, 5.0}, {3.5, 4.1}, {4.5, 5.0}, {8.0, 12.0}}) {
        const Band band = flat_band("", from, to, bin_edges_um());
        const OnwardLight onward(air, 0.2, sun_zenith_deg, band.node_um);
        const SunField field(clear, {.zenith_deg = sun_zenith_deg}, band.node_um);
        const auto sunlight = [&](const SightLine& line) {
            auto sum = solar_at_nodes(clear_air, 0.2, sun_zenith_deg, 1.0, band.node_um, line);
            for (double& x : sum) x *= up;
            const Quadrature square = gauss_legendre(4, 0.0, 1.0);
            for (std::size_t k = 0; k < square.size(); ++k) {
                const double zenith_deg = degrees(std::acos(std::sqrt(square.node[k])));
                const std::array azimuth_deg = {22.5, 67.5, 112.5, 157.5};
                for (const auto& seen : field.skies(0.2, zenith_deg, azimuth_deg, line)) {
                    for (std::size_t n = 0; n < sum.size(); ++n) {
                        sum[n] += 0.25 * square.weight[k] * seen[n];
                    }
                }
            }
            return sum;
        };
        const auto sunlight_here = sunlight({});
        const auto sky_here = mean_sky_at_nodes(air, 0.2, band.node_um, 8);
        for (const auto& [eye_km, range_km] :
             {std::array{0.25, 0.3}, {1.2, 1.0}, {1.2, 5.0}, {5.2, 5.0}, {0.25, 20.0}}) {
            const SightLine line = chord(eye_km, 0.2, range_km);
            const auto way = onward.way(line);
            // Through the cloud only its gaps let light pass.
            const double gap = eye_km > model.cloud.top_km() ? 1.0 - model.cloud.fraction : 1.0;
            const double sun = sum_of(band, sunlight_here, way.sunlight) /
                                   (gap * band_sum_nodes(band, sunlight(line))) -
                               1.0;
            CAPTURE(profile, sun_zenith_deg, model.cloud.fraction, from, to, eye_km, range_km);
            CHECK(std::abs(sun) < 0.015);
            worst_sun = std::max(worst_sun, std::abs(sun));
            if (to < 2.5) continue;  // where the air does not glow
            const double heat =
                sum_of(band, sky_here, way.sky_heat) /
                    band_sum_nodes(band, mean_sky_at_nodes(air, 0.2, band.node_um, 8, line)) -
                1.0;
            CHECK(std::abs(heat) < 0.015);
            worst_heat = std::max(worst_heat, std::abs(heat));
        }
    }
    fmt::print("  {} sun {:g} cloud {:g}: worst of sunlight {:.2f} %, sky's heat {:.2f} %\n",
               profile, sun_zenith_deg, model.cloud.fraction, 100 * worst_sun, 100 * worst_heat);
}

TEST_CASE("without amounts to join, what gets through is the product", "[materials][onward]") {
    const Band band = flat_band("", 3.0, 5.0, bin_edges_um());
    const auto way = OnwardLight(Vacuum{}, 0.0, 30.0, band.node_um).way(chord(1.0, 0.0, 1.0));
    CHECK(way.sunlight == std::vector<double>(band.node_um.size(), 1.0));
    CHECK(way.sky_heat == way.path.transmittance);
}
