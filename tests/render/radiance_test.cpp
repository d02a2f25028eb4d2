#include "render/light/radiance.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/far_ground.hpp"
#include "render/light/incident_at_heights.hpp"
#include "render/light/incident_light.hpp"
#include "render/path/background.hpp"
#include "terrain/place/site.hpp"
#include "tests/support/render_scene.hpp"

#include "render/light/lit_facets.hpp"

using namespace diurna;

namespace {

/// Two facets that see each other and the sky by given shares.
struct Pair {
    FacetSet facets;
    FacetViews sky;
    MaterialLibrary materials;
    std::vector<float> temperature, sun;

    Pair(float sky_view, float factor, float below, std::vector<float> temperatures,
         double reflectance)
        : materials({testing::material("grey", flat_spectrum(reflectance))}),
          temperature(std::move(temperatures)) {
        append_facets(facets,
                      std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                      std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}},
                      std::vector<MaterialId>(2, MaterialId{0}), ObjectId{0});
        sky.sky = {sky_view, sky_view};
        sky.below = {below, below};
        if (factor > 0.0f) {
            sky.others = {.row = {0, 1, 2}, .facet = {1, 0}, .factor = {factor, factor}};
        } else {
            sky.others = {.row = {0, 0, 0}, .facet = {}, .factor = {}};
        }
    }
    RadianceInput input(const Atmosphere& atmosphere) const {
        return {.facets = facets,
                .views = sky,
                .materials = materials,
                .atmosphere = atmosphere,
                .temperature = temperature,
                .sun_fraction = sun};
    }
};

double total(const std::array<double, term_count>& terms) {
    return std::accumulate(terms.begin(), terms.end(), 0.0);
}

const Atmosphere cold_space = Vacuum{.space_temperature = 3.0};

}  // namespace

// A Lambertian plate in the sun without air: L = ρ E cosθ / π, half of it in half shadow.
TEST_CASE("an irradiated plate reflects by Lambert's law", "[render][radiance][by_comparison]") {
    Pair pair(1.0f, 0.0f, 0.0f, {1.0f, 1.0f}, 0.4);
    pair.sun = {1.0f, 0.5f};
    const Band band = flat_band("0.4-0.7", 0.4, 0.7, bin_edges_um());
    RadianceInput input = pair.input(cold_space);
    input.to_sun = direction(130.0, 35.0);
    input.sun_zenith_deg = 55.0;
    input.sun_distance_au = 1.0;
    const double irradiance =
        band_sum_nodes(band, solar_at_nodes(cold_space, 0.0, 55.0, 1.0, band.node_um));
    CHECK(irradiance == Approx(530.0).epsilon(0.05));  // ASTM E490: 0.4-0.7 µm at 1 AU
    const double expected = 0.4 * irradiance * std::cos(radians(55.0)) / std::numbers::pi;
    const auto full = radiance_at_eye(input, band, {100.0, SurfaceId{0}, 100.0, 0.0});
    const auto half = radiance_at_eye(input, band, {100.0, SurfaceId{1}, 100.0, 0.0});
    CHECK(full[std::size_t(Term::sun)] == Approx(expected).epsilon(1e-6));
    CHECK(half[std::size_t(Term::sun)] == Approx(0.5 * expected).epsilon(1e-6));
}

// Ground of reflectance ρ that sees a wall with the factor F, and the wall the ground, in two
// bounces: ε B(T) + ρ F [ε B(T_wall) + ρ F (ε + ρ F) B(T)], space being black and cold.
TEST_CASE("ground reflects a hot wall", "[render][radiance]") {
    const Pair pair(0.7f, 0.3f, 0.0f, {290.0f, 500.0f}, 0.2);
    const Band band = flat_band("3-5", 3.0, 5.0);
    const double ground = band_radiance(band, 290.0), wall = band_radiance(band, 500.0);
    const auto terms =
        radiance_at_eye(pair.input(cold_space), band, {50.0, SurfaceId{0}, 50.0, 0.0});
    CHECK(terms[std::size_t(Term::emitted)] == Approx(0.8 * ground).epsilon(1e-9));
    CHECK(terms[std::size_t(Term::surroundings)] ==
          Approx(0.2 * 0.3 * (0.8 * wall + 0.06 * (0.8 + 0.06) * ground)).epsilon(1e-6));
    CHECK(terms[std::size_t(Term::path)] == 0.0);
}

// Two plates that see each other with the factor F and cold space otherwise: the radiosities are
// J1 = (ε B1 + ρ F ε B2) / (1 − ρ² F²) (Modest, Radiative Heat Transfer, ch. 5). Two bounces leave
// ρ³ F³ of the difference of the black bodies.
TEST_CASE("two facing plates have the closed form's radiosity",
          "[render][radiance][by_comparison]") {
    const double reflectance = GENERATE(0.1, 0.2, 0.3), factor = 0.3,
                 emissivity = 1.0 - reflectance;
    const Pair pair(0.7f, 0.3f, 0.0f, {290.0f, 400.0f}, reflectance);
    const Band band = flat_band("8-12", 8.0, 12.0);
    const double one = band_radiance(band, 290.0), two = band_radiance(band, 400.0);
    const double exchange = reflectance * factor;
    const double exact =
        (emissivity * one + exchange * emissivity * two) / (1.0 - exchange * exchange);
    const auto terms =
        radiance_at_eye(pair.input(cold_space), band, {50.0, SurfaceId{0}, 50.0, 0.0});
    CAPTURE(reflectance);
    if (reflectance < 0.3) CHECK(total(terms) == Approx(exact).epsilon(1e-3));
    CHECK(std::abs(total(terms) - exact) <= exchange * exchange * exchange * (two - one));
}

// 2026-11: a row whose factors had all become zero divided 0 by 0 and blackened its facet.
TEST_CASE("a row of nothing but zeros is no row", "[render][radiance][stress][by_degenerate]") {
    Pair pair(0.8f, 0.2f, 0.2f, {290.0f, 400.0f}, 0.3);
    const Pair without(0.8f, 0.0f, 0.2f, {290.0f, 400.0f}, 0.3);
    pair.sky.others.factor = {0.0f, 0.0f};
    const Band band = flat_band("8-12", 8.0, 12.0);
    const auto found =
        radiance_at_eye(pair.input(cold_space), band, {50.0, SurfaceId{0}, 50.0, 0.0});
    const auto expected =
        radiance_at_eye(without.input(cold_space), band, {50.0, SurfaceId{0}, 50.0, 0.0});
    CHECK(total(found) == Approx(total(expected)).epsilon(1e-12));
    const std::vector<SurfaceId> seen = {SurfaceId{0}, SurfaceId{1}};
    CHECK(lit_facets(pair.input(cold_space), seen, {}).factor.empty());
}

TEST_CASE("ground beyond the scene's edge looks like the surroundings that are there",
          "[render][radiance]") {
    const Band band = flat_band("8-12", 8.0, 12.0);
    const Pair inside(0.5f, 0.5f, 0.0f, {290.0f, 310.0f}, 0.3);
    const Pair at_edge(0.5f, 0.2f, 0.3f, {290.0f, 310.0f}, 0.3);
    const Pair alone(0.5f, 0.0f, 0.5f, {290.0f, 310.0f}, 0.3);
    const auto radiance = [&](const Pair& pair) {
        return total(
            radiance_at_eye(pair.input(cold_space), band, {50.0, SurfaceId{0}, 50.0, 0.0}));
    };
    CHECK(radiance(inside) == Approx(radiance(at_edge)).epsilon(1e-6));
    const double own = band_radiance(band, 290.0);
    CHECK(radiance(alone) == Approx(0.7 * own + 0.3 * 0.5 * own).epsilon(1e-6));
}

// A sky of one temperature without air: ε B(T) + ρ V B(T_sky).
TEST_CASE("a plate reflects the sky it sees", "[render][radiance]") {
    const Pair pair(1.0f, 0.0f, 0.0f, {300.0f, 300.0f}, 0.9);
    const Band band = flat_band("8-12", 8.0, 12.0);
    const Atmosphere shell = Vacuum{.space_temperature = 220.0};
    const auto terms = radiance_at_eye(pair.input(shell), band, {50.0, SurfaceId{0}, 50.0, 0.0});
    CHECK(
        total(terms) ==
        Approx(0.1 * band_radiance(band, 300.0) + 0.9 * band_radiance(band, 220.0)).epsilon(1e-9));
}

TEST_CASE("glass shows the room behind it below 5 µm and none above", "[render][radiance]") {
    Pair pair(1.0f, 0.0f, 0.0f, {270.0f, 270.0f}, 0.0);
    pair.materials = MaterialLibrary({testing::materials(300.0)[MaterialId{testing::glass}]});
    const auto behind = [&](const Band& band) {
        return radiance_at_eye(pair.input(cold_space), band,
                               {50.0, SurfaceId{0}, 50.0, 0.0})[std::size_t(Term::behind)];
    };
    CHECK(behind(flat_band("8-12", 8.0, 12.0)) == 0.0);
    // τ is 0.75 at 2.7 µm and 0.4 at 3.5 µm, linear between.
    const Band band = flat_band("3-3.5", 3.0, 3.5);
    double expected = 0.0;
    for (std::size_t n = 0; n < band.node_um.size(); ++n) {
        const double through = 0.75 - (band.node_um[n] - 2.7) / 0.8 * 0.35;
        expected += band.weight[n] * through * planck(band.node_um[n], 300.0);
    }
    CHECK(behind(band) == Approx(expected).epsilon(1e-9));
}

namespace {

RadianceInput summer_air(const Pair& pair, const Atmosphere& air) {
    RadianceInput input = pair.input(air);
    input.ground_height_km = 0.2;
    return input;
}
const Atmosphere summer =
    BandModel{.profile = afgl_profile("MLS"), .aerosol = "rural", .visibility_km = 23.0};

}  // namespace

TEST_CASE("the segments of a chord are fine enough for 2 mK", "[render][radiance]") {
    const Pair pair(1.0f, 0.0f, 0.0f, {290.0f, 290.0f}, 0.1);
    const RadianceInput input = summer_air(pair, summer);
    const Band band = GENERATE(flat_band("3-5", 3.0, 5.0, bin_edges_um()),
                               flat_band("8-12", 8.0, 12.0, bin_edges_um()));
    const double range = GENERATE(300.0, 3000.0, 30000.0);
    const double up = GENERATE(20.0, 500.0, 3000.0);
    if (up > range) return;
    const auto temperature = [&](int segments) {
        return brightness_temperature(
            band, total(radiance_at_eye(input, band, {up, SurfaceId{0}, range, 0.0}, segments)));
    };
    CAPTURE(band.name, range, up);
    CHECK(std::abs(temperature(0) - temperature(400)) < 2e-3);
}

TEST_CASE("the mean sky agrees with a fine integral over the hemisphere",
          "[render][radiance][by_comparison]") {
    const Pair pair(1.0f, 0.0f, 0.0f, {290.0f, 290.0f}, 0.1);
    const RadianceInput input = summer_air(pair, summer);
    const Band band = GENERATE(flat_band("3-5", 3.0, 5.0, bin_edges_um()),
                               flat_band("8-12", 8.0, 12.0, bin_edges_um()));
    const double mean = band_sum_nodes(band, incident_light(input, 0.4, band.node_um).sky);
    double fine = 0.0;
    constexpr int n = 400;  // midpoints in cos²θ
    for (int i = 0; i < n; ++i) {
        const double zenith = degrees(std::acos(std::sqrt((i + 0.5) / n)));
        fine += band_sum_nodes(band, sky_at_nodes(summer, 0.4, zenith, band.node_um)) / n;
    }
    CHECK(mean == Approx(fine).epsilon(1e-3));
}

TEST_CASE("between two heights 29 m apart the sky's light is their mean, farther its own",
          "[render][radiance]") {
    const Pair pair(1.0f, 0.0f, 0.0f, {290.0f, 290.0f}, 0.1);
    const RadianceInput input = summer_air(pair, summer);
    const Band band = GENERATE(flat_band("3-5", 3.0, 5.0, bin_edges_um()),
                               flat_band("8-12", 8.0, 12.0, bin_edges_um()));
    const auto sky = [&](const IncidentLight& light) { return band_sum_nodes(band, light.sky); };
    const auto near = incident_at_heights(input, {0.200, 0.2145, 0.229}, band.node_um, nullptr);
    const double middle = sky(incident_light(input, 0.2145, band.node_um));
    CHECK(sky(near[1]) == Approx(middle).epsilon(1e-4));
    CHECK(sky(near[0]) - sky(near[2]) > 1e-3 * middle);
    const auto far = incident_at_heights(input, {0.2, 0.3, 0.4}, band.node_um, nullptr);
    CHECK(sky(far[1]) == sky(incident_light(input, 0.3, band.node_um)));
    const auto level = incident_at_heights(input, {0.2, 0.2, 0.2}, band.node_um, nullptr);
    CHECK(sky(level[2]) == sky(near[0]));
}

TEST_CASE("the background changes from sky to plain at the horizon", "[render][radiance]") {
    const Pair pair(1.0f, 0.0f, 0.0f, {290.0f, 290.0f}, 0.1);
    const RadianceInput input = summer_air(pair, summer);
    const Band band = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    const double horizon = horizon_zenith_deg(input, 0.7);
    // The dip of the horizon from 500 m: acos(R / (R + h)) = 0.718°.
    CHECK(horizon == Approx(90.7178).margin(1e-3));
    const auto temperature = [&](double zenith) {
        return brightness_temperature(
            band, band_sum_nodes(band, background_at(input, 0.7, zenith, band.node_um)));
    };
    CHECK(std::abs(temperature(horizon - 0.01) - temperature(horizon + 0.01)) < 0.5);
    // Straight down through 500 m of air: nearly the ground's air temperature, 294.2 K less
    // 4.5 K/km over the first kilometre.
    CHECK(temperature(180.0) == Approx(293.3).margin(0.3));
}

// E = E_direct cosθ + E_diffuse on the horizontal, L = ρ E / π of a Lambertian plane.
TEST_CASE("a plane under the sky reflects the direct and the scattered sunlight",
          "[render][radiance][sunlight]") {
    const double reflectance = GENERATE(1.0, 0.3);
    Pair pair(1.0f, 0.0f, 0.0f, {290.0f, 290.0f}, reflectance);
    pair.sun = {1.0f, 0.0f};
    const Band band = flat_band("0.4-0.7", 0.4, 0.7, bin_edges_um());
    RadianceInput input = summer_air(pair, summer);
    input.to_sun = direction(130.0, 40.0);
    input.sun_zenith_deg = 50.0;
    const SunFlux flux = SunField(std::get<BandModel>(summer), {.zenith_deg = 50.0}, band.node_um)
                             .flux(input.ground_height_km);
    const double direct = band_sum_nodes(band, flux.direct) * std::cos(radians(50.0));
    const double diffuse = band_sum_nodes(band, flux.down);
    const double above =
        std::cos(radians(50.0)) *
        band_sum_nodes(band, solar_at_nodes(Vacuum{}, 0.0, 50.0, 1.0, band.node_um));
    CHECK(diffuse > 0.1 * direct);
    CHECK(direct + diffuse < above);
    const auto leaving = [&](std::uint32_t facet) {
        double sum = 0.0;
        for (const auto& term : radiosity_terms(input, SurfaceId{facet}, band.node_um)) {
            sum += band_sum_nodes(band, term);
        }
        return sum;
    };
    CHECK(leaving(0) == Approx(reflectance * (direct + diffuse) / std::numbers::pi).epsilon(1e-4));
    // In shadow without what of the sky within 12° of the sun is brighter than at 12° from it: here
    // summed over directions.
    const SunField field(std::get<BandModel>(summer), {.zenith_deg = 50.0}, band.node_um);
    const auto sky_at = [&](double from_sun_deg, double turn) {
        const Eigen::Vector3d sun = direction(0.0, 40.0), up = direction(180.0, 50.0);
        const double a = radians(from_sun_deg);
        const Eigen::Vector3d way =
            std::cos(a) * sun +
            std::sin(a) * (std::cos(turn) * up + std::sin(turn) * Eigen::Vector3d::UnitX());
        return std::pair{
            way.z(),
            band_sum_nodes(band, field.sky(input.ground_height_km, degrees(std::acos(way.z())),
                                           degrees(std::atan2(way.x(), way.y()))))};
    };
    double aureole = 0.0;
    constexpr int rings = 24, sectors = 16;
    for (int j = 0; j < sectors; ++j) {
        const double turn = 2.0 * std::numbers::pi * (j + 0.5) / sectors;
        const double edge = sky_at(12.0, turn).second;
        for (int i = 0; i < rings; ++i) {
            const double ring = std::cos(radians(0.5 * i)) - std::cos(radians(0.5 * (i + 1)));
            const auto [cosine, radiance] = sky_at(0.5 * (i + 0.5), turn);
            aureole += ring * 2.0 * std::numbers::pi / sectors * cosine * (radiance - edge);
        }
    }
    CHECK(aureole > 0.02 * diffuse);
    CHECK(leaving(1) == Approx(reflectance * (diffuse - aureole) / std::numbers::pi).epsilon(0.01));
}

TEST_CASE("sunlight is scattered by day, below 5 µm, and in air alone",
          "[render][radiance][sunlight]") {
    Pair pair(1.0f, 0.0f, 0.0f, {290.0f, 290.0f}, 0.3);
    const Band visible = flat_band("0.4-0.7", 0.4, 0.7, bin_edges_um());
    const Band thermal = flat_band("8-12", 8.0, 12.0, bin_edges_um());
    RadianceInput night = summer_air(pair, summer);
    night.sun_zenith_deg = 50.0;
    CHECK_FALSE(scattered_sun(night, visible.node_um));
    pair.sun = {1.0f, 1.0f};
    RadianceInput day = summer_air(pair, summer);
    day.sun_zenith_deg = 50.0;
    CHECK(scattered_sun(day, visible.node_um));
    CHECK_FALSE(scattered_sun(day, thermal.node_um));
    RadianceInput airless = pair.input(cold_space);
    airless.sun_zenith_deg = 50.0;
    CHECK_FALSE(scattered_sun(airless, visible.node_um));
    day.sun_zenith_deg = 91.0;
    CHECK_FALSE(scattered_sun(day, visible.node_um));
}

// A level facet under an open sky and the ground that goes on beyond it are the same thing, seen
// straight down through the same air. The sky that far ground reflects is attenuated as if it were
// emitted: 0.6 % too much in 3-5 and 8-12 µm.
TEST_CASE("ground beyond the scene's edge is seen as a level facet of it is",
          "[render][radiance][by_comparison]") {
    Pair pair(1.0f, 0.0f, 0.0f, {310.0f, 310.0f}, 0.2);
    pair.sun = {1.0f, 1.0f};
    const auto [from, to, allowed] = GENERATE(
        std::tuple{0.4, 0.7, 2e-3}, std::tuple{3.0, 5.0, 8e-3}, std::tuple{8.0, 12.0, 8e-3});
    const Band band = flat_band("band", from, to, bin_edges_um());
    RadianceInput input = summer_air(pair, summer);
    input.to_sun = direction(130.0, 40.0);
    input.sun_zenith_deg = 50.0;
    input.beyond = FarGround{
        .material = MaterialId{0}, .temperature = 310.0, .height_km = input.ground_height_km};
    const auto scattered = scattered_sun(input, band.node_um);
    const LightByOrigin far =
        far_ground_light(input, band.node_um, scattered ? &*scattered : nullptr);
    const double above_m = 800.0, eye_km = input.ground_height_km + 1e-3 * above_m;
    double found = band_sum_nodes(band, background_at(input, eye_km, 180.0, band.node_um, {}, far));
    if (scattered) {
        const double azimuth = 0.0;
        found += band_sum_nodes(
            band,
            scattered_backgrounds_at(input, *scattered, eye_km, 180.0, {&azimuth, 1}).front());
    }
    const double facet = total(radiance_at_eye(input, band, {above_m, SurfaceId{0}, above_m, 0.0},
                                               0, scattered ? &*scattered : nullptr));
    double path = 0.0;
    if (scattered) {
        const SightLine line = chord(eye_km, input.ground_height_km, 1e-3 * above_m);
        const double angle = scattered->angle_from_sun_deg(180.0, 0.0);
        const auto light = scattered->path_by_turn(line, {&angle, 1}, {});
        std::vector<double> radiance = light.at_angle.front();
        for (std::size_t n = 0; n < radiance.size(); ++n) radiance[n] -= light.by_cosine[n];
        path = band_sum_nodes(band, radiance);
    }
    CAPTURE(from, to);
    CHECK(found == Approx(facet + path).epsilon(allowed));
}

TEST_CASE("heights on both sides of a cloud's top do not share light", "[render][radiance]") {
    for (const float y : {-1.0f, -0.3f, 0.0f, 0.7f, 1.0f, 4.0f, 4.25f, 5.0f, 8.0f}) {
        const auto up = height_weights(y);
        CHECK(up[0] + up[1] + up[2] == Approx(1.0f));
    }
    CHECK(height_weights(4.25f)[0] == Approx(0.75f));
    CHECK(height_weights(4.25f)[2] == 0.0f);
    CHECK(height_weights(height_above_edge)[2] == 1.0f);
}
