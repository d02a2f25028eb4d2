#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/incident_light.hpp"
#include "render/light/radiance.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/plates_under_sky.hpp"
#include "tests/support/render_scene.hpp"

// What plates of all slopes reflect of the program's own sky, against sums over its directions one
// by one, on open ground and in a street.

using namespace diurna;
using std::numbers::pi;
using testing::Plates;
using testing::tilt_deg;

namespace {

constexpr double reflectance = 0.7, warm = 295.0;

/// The sky's radiance in a band over zenith and azimuth from the sun, straight in between.
struct SkyTable {
    static constexpr int rings = 60, sectors = 72;  // evenly in √cos z; over half the circle
    std::vector<double> value = std::vector<double>((rings + 1) * (sectors + 1));

    static double zenith_deg(int i) {
        const double t = std::max(0.02, double(i) / rings);
        return degrees(std::acos(t * t));
    }
    double& at(int i, int j) { return value[std::size_t(i * (sectors + 1) + j)]; }
    double operator()(const Eigen::Vector3d& way, const Eigen::Vector3d& to_sun) const {
        const double turn = std::abs(std::remainder(
            std::atan2(way.x(), way.y()) - std::atan2(to_sun.x(), to_sun.y()), 2.0 * pi));
        const double u = std::sqrt(way.z()) * rings, v = turn / pi * sectors;
        const int i = std::min(int(u), rings - 1), j = std::min(int(v), sectors - 1);
        const auto here = [&](int r) {
            const auto k = std::size_t((i + r) * (sectors + 1) + j);
            return std::lerp(value[k], value[k + 1], v - j);
        };
        return std::lerp(here(0), here(1), u - i);
    }
};

struct Light {
    Plates plates;
    FacetViews views;
    MaterialLibrary materials{{testing::material("plate", flat_spectrum(reflectance))}};
    std::vector<float> temperature, sun;
    Atmosphere air =
        BandModel{.profile = afgl_profile("MLS"), .aerosol = "rural", .visibility_km = 23.0};

    explicit Light(bool street)
        : plates(street),
          views(facet_views(plates.facets, RayScene(plates.facets),
                            {.rays = 65535, .others = false})),
          temperature(plates.facets.size(), float(warm)) {
        views.others.row.assign(plates.facets.size() + 1, 0);
    }
    RadianceInput input(const Eigen::Vector3d& to_sun, double zenith_deg) const {
        return {.facets = plates.facets,
                .views = views,
                .materials = materials,
                .atmosphere = air,
                .temperature = temperature,
                .sun_fraction = sun,
                .to_sun = to_sun,
                .sun_zenith_deg = zenith_deg,
                .ground_height_km = 0.2};
    }
    /// The light of sky and sun on a plate, over π.
    std::array<double, 2> found(const RadianceInput& of, const Band& band, std::size_t k,
                                const ScatteredSun* scattered) const {
        const SurfaceId facet{std::uint32_t(plates.plate[k])};
        const NodeTerms terms = radiosity_terms(of, facet, band.node_um, 0, scattered);
        const auto sum = [&](Term t) {
            return band_sum_nodes(band, terms[std::size_t(t)]) / reflectance;
        };
        return {sum(Term::sky), of.sun_fraction.empty() ? 0.0 : sum(Term::sun)};
    }
};

}  // namespace

TEST_CASE("plates of all slopes mirror the heat of the sky they see", "[render][sky]") {
    const Light light(GENERATE(false, true));
    const Band band = GENERATE(flat_band("8-12", 8.0, 12.0, bin_edges_um()),
                               flat_band("3-5", 3.0, 5.0, bin_edges_um()));
    const RadianceInput input = light.input(Eigen::Vector3d::UnitZ(), 180.0);
    SkyTable table;
    for (int i = 0; i <= SkyTable::rings; ++i) {
        const double sky = band_sum_nodes(
            band, sky_at_nodes(light.air, 0.202, SkyTable::zenith_deg(i), band.node_um));
        for (int j = 0; j <= SkyTable::sectors; ++j) table.at(i, j) = sky;
    }
    for (std::size_t k = 0; k < tilt_deg.size(); ++k) {
        const double expected = light.plates.sum(tilt_deg[k], [&](const Eigen::Vector3d& way) {
            return table(way, Eigen::Vector3d::UnitX());
        });
        const double found = light.found(input, band, k, nullptr)[0];
        const double kelvin =
            reflectance * (found - expected) / band_radiance_derivative(band, warm);
        CAPTURE(band.name, light.plates.street, tilt_deg[k], expected);
        CHECK(found == Approx(expected).epsilon(0.03));
        CHECK(std::abs(kelvin) < 0.3);
    }
}

TEST_CASE("plates of all slopes mirror the sunlight of the sky they see", "[render][sky]") {
    Light light(GENERATE(false, true));
    const Band band = GENERATE(flat_band("0.4-0.7", 0.4, 0.7, bin_edges_um()),
                               flat_band("0.7-1.0", 0.7, 1.0, bin_edges_um()));
    const double sun_zenith_deg = GENERATE(25.0, 50.0, 70.0, 80.0);
    const double sun_azimuth_deg = GENERATE(225.0, 150.0, 45.0);
    const Eigen::Vector3d to_sun = direction(sun_azimuth_deg, 90.0 - sun_zenith_deg);
    const double cross = std::abs(to_sun.dot(light.plates.over));
    const bool lit = !light.plates.street || to_sun.z() * testing::half_width >
                                                 cross * (testing::wall - testing::plate_height);
    light.sun.assign(light.plates.facets.size(), lit ? 1.0f : 0.0f);
    const RadianceInput input = light.input(to_sun, sun_zenith_deg);
    const auto scattered = scattered_sun(input, band.node_um);
    REQUIRE(scattered);
    SkyTable table;
    std::vector<double> azimuth_deg;
    for (int j = 0; j <= SkyTable::sectors; ++j)
        azimuth_deg.push_back(180.0 * j / SkyTable::sectors);
    for (int i = 0; i <= SkyTable::rings; ++i) {
        const auto skies = scattered->skies(0.202, SkyTable::zenith_deg(i), azimuth_deg);
        for (int j = 0; j <= SkyTable::sectors; ++j) {
            table.at(i, j) = band_sum_nodes(band, skies[std::size_t(j)]);
        }
    }
    // Its sum over level ground is the flux of two streams, which is kept.
    const auto toward = [&](const Eigen::Vector3d& way) { return table(way, to_sun); };
    const double level = band_sum_nodes(band, scattered->flux(0.202).down) / pi;
    const double scale = level / Plates(false).sum(0.0, toward);
    const double beam =
        band_sum_nodes(band, solar_at_nodes(light.air, 0.202, sun_zenith_deg, 1.0, band.node_um)) /
        pi;
    const double heat = band_sum_nodes(band, incident_light(input, 0.202, band.node_um).sky);
    REQUIRE(heat < 1e-6 * level);
    const double ground = level + beam * to_sun.z();
    for (std::size_t k = 0; k < tilt_deg.size(); ++k) {
        const double direct =
            lit ? beam * std::max(0.0, Plates::normal(tilt_deg[k]).dot(to_sun)) : 0.0;
        const double expected = scale * light.plates.sum(tilt_deg[k], toward) + direct;
        const auto found = light.found(input, band, k, &*scattered);
        const double all = found[0] + found[1];
        CAPTURE(band.name, sun_zenith_deg, sun_azimuth_deg, light.plates.street, tilt_deg[k]);
        // A sky of one mean was off by up to 230 % of the light expected, a fit over the whole sky
        // by 28 %. What is left where walls hide the sun is its aureole, which they hide with it.
        CHECK(std::abs(all - expected) < 0.02 * ground);
        CHECK(all == Approx(expected).epsilon(lit ? 0.03 : 0.12));
    }
}
