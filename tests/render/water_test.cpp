#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "materials/base/units.hpp"
#include "materials/matter/read_library.hpp"
#include "materials/radiation/planck.hpp"
#include "render/rays/secondary_light.hpp"
#include "tests/support/isothermal.hpp"
#include "tests/support/sea.hpp"
#include "tests/support/secondary_stage.hpp"

using namespace diurna;

namespace {

Material water() {
    static const MaterialLibrary library = default_material_library();
    return library[library.find("water")];
}

/// The eye 3 m (or `up`) over a wide lake, a pixel that looks down at an angle [deg].
struct Lake {
    SecondaryStage stage;
    Observer eye;
    explicit Lake(double down_deg, double wind, Atmosphere air, float kelvins = 290.0f,
                  double up = 3.0) {
        stage.air = std::move(air);
        stage.wind_speed = wind;
        stage.rectangle({{-300, -300, -up}, {300, -300, -up}, {300, 300, -up}, {-300, 300, -up}},
                        water(), kelvins);
        eye = stage.observer(1, 0.02);
        eye.elevation_deg = -down_deg;
    }
};

Atmosphere summer() {
    return BandModel{.profile = afgl_profile("MLS"), .aerosol = "rural", .visibility_km = 23.0};
}

/// The sky at a band's nodes, straight between zenith angles that crowd at the horizon.
class SkyByAngle {
 public:
    /// - behind_km: from how far behind that place along the same line
    SkyByAngle(const Atmosphere& air, double height_km, const Band& band, double behind_km = 0.0) {
        for (int i = 0; i <= steps; ++i) {
            const double from_km = height_km - behind_km * std::cos(radians(zenith_deg(i)));
            sky_.push_back(sky_at_nodes(air, from_km, zenith_deg(i), band.node_um));
        }
    }
    double at(double up, std::size_t node) const {
        const double place = steps * (1.0 - std::sqrt(degrees(std::asin(up)) / 90.0));
        const auto i = std::min(static_cast<std::size_t>(place), std::size_t(steps - 1));
        return std::lerp(sky_[i][node], sky_[i + 1][node], place - double(i));
    }

 private:
    static constexpr int steps = 60;
    static double zenith_deg(int i) {
        return std::min(89.99, 90.0 - 90.0 * std::pow(1.0 - double(i) / steps, 2));
    }
    std::vector<std::vector<double>> sky_;
};

/// By slopes, Fresnel and the sky's radiance by angle: what the water sends to an eye.
double lake_radiance(double down_deg, double wind, const Atmosphere& air, const Band& band,
                     double kelvins, double height_km) {
    const SkyByAngle sky(air, height_km, band);
    const std::size_t nodes = band.node_um.size();
    std::vector<double> light(nodes, 0.0), mirrored(nodes, 0.0);
    Sea{wind}.each_wave(
        std::sin(radians(down_deg)),
        [&](double share, double cosine, const Eigen::Vector3d& out) {
            for (std::size_t n = 0; n < nodes; ++n) {
                const double r = share * Sea::reflectance(cosine, Sea::index(band.node_um[n]));
                mirrored[n] += r;
                light[n] += r * sky.at(out.z(), n);
            }
        },
        240);
    double sum = 0.0;
    for (std::size_t n = 0; n < nodes; ++n) {
        sum += band.weight[n] * ((1.0 - mirrored[n]) * planck(band.node_um[n], kelvins) + light[n]);
    }
    return sum;
}

}  // namespace

// 5° above the water the Lambertian pond of emissivity 0.99 was 4.2 K too warm.
TEST_CASE("a lake by night is the sum over its waves, at any angle",
          "[render][water][by_comparison]") {
    const double wind = GENERATE(1.0, 3.0, 8.0);
    const Atmosphere air = summer();
    const Band band = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    for (const double down_deg : {1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 45.0, 90.0}) {
        Lake lake(down_deg, wind, air, 290.0f, 0.1);  // so that no air is on the way
        const auto seen = lake.stage.look(lake.eye, band);
        const double found = brightness_temperature(band, seen.at(0));
        const double expected =
            brightness_temperature(band, lake_radiance(down_deg, wind, air, band, 290.0, 0.2999));
        CAPTURE(wind, down_deg, found, expected);
        CHECK(std::abs(found - expected) < (down_deg < 2.0 ? 0.03 : 0.02));
    }
}

// From 3 m above it the eye is up to 172 m away, and what the waves mirror has met the air of both
// legs: a line to the sky that begins so far behind the water passes nearly the same air, and no
// law of joined paths is needed. Sky times transmittance would be 0.26 K warmer at 1°.
TEST_CASE("a lake seen from afar mirrors a sky of one path", "[render][water][path]") {
    const double wind = GENERATE(3.0, 8.0);
    const Atmosphere air = summer();
    const Band band = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    for (const double down_deg : {1.0, 2.0, 5.0}) {
        Lake lake(down_deg, wind, air);
        const auto seen = lake.stage.look(lake.eye, band);
        const double found = brightness_temperature(band, seen.at(0));

        const double range_km = 0.003 / std::sin(radians(down_deg));
        const SkyByAngle behind(air, 0.297, band, range_km);
        const PathSpectrum path = path_at_nodes(
            air, line_of(std::get<BandModel>(air), 0.3, 90.0 + down_deg, range_km), band.node_um);
        const auto nodes = band.node_um.size();
        std::vector<double> mirrored(nodes, 0.0), light(nodes, 0.0);
        Sea{wind}.each_wave(
            std::sin(radians(down_deg)),
            [&](double share, double cosine, const Eigen::Vector3d& out) {
                for (std::size_t n = 0; n < nodes; ++n) {
                    const double r = share * Sea::reflectance(cosine, Sea::index(band.node_um[n]));
                    mirrored[n] += r;
                    light[n] += r * (behind.at(out.z(), n) - path.radiance[n]);
                }
            },
            240);
        double sum = 0.0;
        for (std::size_t n = 0; n < nodes; ++n) {
            const double own = (1.0 - mirrored[n]) * planck(band.node_um[n], 290.0);
            sum += band.weight[n] * (path.transmittance[n] * own + light[n] + path.radiance[n]);
        }
        const double expected = brightness_temperature(band, sum);
        CAPTURE(wind, down_deg, found, expected);
        CHECK(std::abs(found - expected) < 0.03);
    }
}

// L = E F(χ) P(slopes) / (4 cosθ cos⁴β): Cox & Munk 1954. P the Gaussian density of slopes, β the
// tilt of the waves that shine, E the sun's on a plane facing it; no air.
TEST_CASE("the sun glitters on water as Cox and Munk have it",
          "[render][water][glint][by_history]") {
    const double wind = GENERATE(2.0, 6.0, 12.0);
    const Band band = flat_band("1.5-1.8", 1.5, 1.8, bin_edges_um());
    for (const double sun_deg : {30.0, 50.0}) {
        for (const double down_deg : {25.0, 40.0, 60.0}) {
            for (const double aside_deg : {0.0, 8.0, 20.0}) {
                Lake lake(down_deg, wind, Vacuum{.space_temperature = 3.0});
                lake.stage.to_sun = direction(aside_deg, sun_deg);
                lake.stage.sun.assign(lake.stage.facets.size(), 1.0f);
                const auto seen = lake.stage.look(lake.eye, band);
                const double found = double{seen.planes[std::size_t(Term::sun)][0]};

                const Eigen::Vector3d eye = -direction(0.0, -down_deg);
                const Eigen::Vector3d wave = (eye + lake.stage.to_sun).normalized();
                const double rise = (1.0 - wave.z() * wave.z()) / (wave.z() * wave.z());
                const double variance = 0.003 + 0.00512 * wind;
                const double slopes = std::exp(-rise / variance) / (std::numbers::pi * variance);
                if (slopes < 0.02) continue;  // no glint
                const double reflected = Sea::reflectance(eye.dot(wave), {1.3165, 1.0e-4});
                const double sun = band_sum_nodes(
                    band, solar_at_nodes(Vacuum{}, 0.3, 90.0 - sun_deg, 1.0, band.node_um));
                const double expected =
                    sun * reflected * slopes / (4.0 * eye.z() * std::pow(wave.z(), 4));
                CAPTURE(wind, sun_deg, down_deg, aside_deg, slopes);
                CHECK(found == Approx(expected).epsilon(0.03));
            }
        }
    }
}

TEST_CASE("water, gloss and rough metal as warm as all around look black",
          "[render][water][furnace][by_degenerate]") {
    const double kelvins = GENERATE(260.0, 300.0);
    const Band band = GENERATE(flat_band("3-5", 3.0, 5.0, bin_edges_um()),
                               flat_band("8-12", 8.0, 12.0, bin_edges_um()));
    const auto warm = static_cast<float>(kelvins);
    Lake lake(6.0, 4.0,
              BandModel{.profile = isothermal(afgl_profile("MLS"), kelvins),
                        .aerosol = "rural",
                        .visibility_km = 5.0,
                        .space_temperature = kelvins},
              warm);
    lake.stage.rectangle({{-20, 60, -3}, {-4, 70, -3}, {-4, 70, 5}, {-20, 60, 5}}, metal(0.9, 0.3),
                         warm);
    lake.stage.rectangle({{4, 50, -3}, {20, 55, -3}, {20, 55, 5}, {4, 50, 5}}, plain(0.4), warm);
    lake.eye.width = lake.eye.height = 25;
    lake.eye.horizontal_fov_deg = 16.0;
    const auto seen = lake.stage.look(lake.eye, band);
    REQUIRE(seen.secondary_rays.pixel.size() > 300);
    double worst = 0.0;
    for (const std::uint32_t p : seen.secondary_rays.pixel) {
        worst = std::max(worst, std::abs(seen.at(p) / band_radiance(band, kelvins) - 1.0));
    }
    CAPTURE(kelvins, band.name, worst);
    CHECK(worst < 1e-6);
}

// A closed hall as warm as the water, the sky outside at 3 K: what the lobe's sum takes for sky is
// roof. At 16 samples 2.2 K of speckle, before the sum knew how much of the sky is open.
TEST_CASE("water under a roof has no speckle",
          "[render][water][furnace][speckle][by_replication]") {
    const Band band = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    Lake lake(12.0, 4.0, Vacuum{.space_temperature = 3.0});
    const auto side = [&](std::vector<Eigen::Vector3d> corner) {
        lake.stage.rectangle(std::move(corner), plain(0.02), 290.0f);
    };
    side({{-300, -300, 30}, {-300, 300, 30}, {300, 300, 30}, {300, -300, 30}});
    side({{-300, 300, -3}, {300, 300, -3}, {300, 300, 30}, {-300, 300, 30}});
    side({{300, -300, -3}, {-300, -300, -3}, {-300, -300, 30}, {300, -300, 30}});
    side({{300, 300, -3}, {300, -300, -3}, {300, -300, 30}, {300, 300, 30}});
    side({{-300, -300, -3}, {-300, 300, -3}, {-300, 300, 30}, {-300, -300, 30}});
    lake.eye.width = lake.eye.height = 12;
    const auto seen = lake.stage.look(lake.eye, band, 4, true);
    REQUIRE(seen.secondary_rays.pixel.size() == 144);
    double worst = 0.0;
    for (const std::uint32_t p : seen.secondary_rays.pixel) {
        worst = std::max(worst, std::abs(brightness_temperature(band, seen.at(p)) - 290.0));
    }
    CAPTURE(worst);
    CHECK(worst < 0.1);
    for (std::size_t i = 0; i < seen.reference.size(); ++i) {
        CHECK(seen.at(seen.secondary_rays.pixel[41 * i]) ==
              Approx(seen.reference[i]).epsilon(1e-4));
    }
}

// Waves by slope, each ray of theirs followed to the wall (black, 310 K) or past it to the sky
// (250 K): 16 samples a pixel. By as many rays into the lobe, spread otherwise, 0.6 K rms.
TEST_CASE("water before a warm wall has no speckle", "[render][water][speckle][by_replication]") {
    const double wind = GENERATE(1.0, 3.0, 8.0);
    const double down_deg = GENERATE(6.0, 20.0);
    const double wall_m = GENERATE(1.05, 2.0);  // of the way to where the water is looked at
    const Band band = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    const double at_m = 3.0 / std::tan(radians(down_deg)), north = wall_m * at_m;
    Lake lake(down_deg, wind, Vacuum{.space_temperature = 250.0});
    lake.stage.rectangle({{-15, north, -3}, {15, north, -3}, {15, north, 3}, {-15, north, 3}},
                         plain(0.0), 310.0f);
    lake.eye.width = lake.eye.height = 16;
    lake.eye.horizontal_fov_deg = 0.02;
    const auto seen = lake.stage.look(lake.eye, band, 16);
    CAPTURE(wind, down_deg, wall_m);
    REQUIRE(seen.secondary_rays.pixel.size() == 256);

    double wall = 0.0, sky = 0.0, water = 0.0;
    Sea{wind}.each_wave(
        std::sin(radians(down_deg)),
        [&](double share, double cosine, const Eigen::Vector3d& out) {
            const double along = (north - at_m) / -out.x();
            const bool meets =
                along > 0.0 && std::abs(along * out.y()) < 15.0 && along * out.z() < 6.0;
            for (std::size_t n = 0; n < band.node_um.size(); ++n) {
                const double um = band.node_um[n];
                const double r = share * Sea::reflectance(cosine, Sea::index(um)) * band.weight[n];
                water -= r * planck(um, 290.0);
                (meets ? wall : sky) += r * planck(um, meets ? 310.0 : 250.0);
            }
        },
        240);
    const double expected =
        brightness_temperature(band, band_radiance(band, 290.0) + water + wall + sky);
    double mean = 0.0, square = 0.0;
    for (const std::uint32_t p : seen.secondary_rays.pixel) {
        const double off = brightness_temperature(band, seen.at(p)) - expected;
        mean += off / 256.0;
        square += off * off / 256.0;
    }
    CAPTURE(wind, down_deg, wall_m, expected, wall / (wall + sky), mean, square);
    CHECK(std::abs(mean) < 0.1);
    CHECK(std::sqrt(square - mean * mean) < 0.2);
}

// A plate of rough metal, 45° back over warm ground: 16 samples a pixel against many.
TEST_CASE("rough metal has no speckle", "[render][water][speckle][by_replication]") {
    const double roughness = GENERATE(0.1, 0.3, 0.6);
    const Band band = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    SecondaryStage stage;
    stage.air = summer();
    stage.rectangle({{-900, -900, -3}, {900, -900, -3}, {900, 900, -3}, {-900, 900, -3}},
                    plain(0.05), 310.0f);
    stage.rectangle({{-4, 50, -2}, {4, 50, -2}, {4, 55, 3}, {-4, 55, 3}}, metal(0.9, roughness),
                    300.0f);
    const Observer eye = stage.observer(12, 2.0);
    std::array<double, 2> mean{}, square{};
    std::array<int, 2> count{};
    for (const int i : {0, 1}) {
        const auto seen = stage.look(eye, band, i == 0 ? 16 : 1024);
        for (const std::uint32_t p : seen.secondary_rays.pixel) {
            const double t = brightness_temperature(band, seen.at(p));
            mean[std::size_t(i)] += t;
            square[std::size_t(i)] += t * t;
            ++count[std::size_t(i)];
        }
        mean[std::size_t(i)] /= count[std::size_t(i)];
        square[std::size_t(i)] /= count[std::size_t(i)];
    }
    const double speckle = std::sqrt(std::max(0.0, square[0] - mean[0] * mean[0]));
    const double smooth = std::sqrt(std::max(0.0, square[1] - mean[1] * mean[1]));
    CAPTURE(roughness, mean[0], mean[1], speckle, smooth);
    CHECK(count[0] == 144);
    CHECK(std::abs(mean[0] - mean[1]) < 0.1);
    CHECK(std::sqrt(std::max(0.0, speckle * speckle - smooth * smooth)) < 0.2);
}
