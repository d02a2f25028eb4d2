#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/cloud_on_line.hpp"
#include "materials/atmosphere/onward_light.hpp"
#include "materials/atmosphere/sun_field.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

using namespace diurna;

namespace {

const std::vector<double> window_um = {8.5, 10.0, 11.5};

BandModel cloudy(double cover) {
    BandModel model{.profile = afgl_profile("MLS"), .aerosol = "rural"};
    model.cloud = {.fraction = cover, .base_km = 1.0, .depth_km = 0.4};
    return model;
}

}  // namespace

TEST_CASE("from above an overcast sky is its cloud's top behind the air over it",
          "[materials][cloud]") {
    const double eye_km = GENERATE(1.5, 3.0, 12.0), slant = GENERATE(1.0, 1.6);
    const BandModel model = cloudy(1.0), clear = cloudy(0.0);
    const auto seen = path_at_nodes(model, chord(eye_km, 0.0, slant * eye_km), window_um);
    const double to_top = slant * (eye_km - 1.4);
    const auto air = path_at_nodes(clear, chord(eye_km, 1.4, to_top), window_um);
    const double top = air_at(clear.profile, 1.4).temperature;
    for (std::size_t n = 0; n < window_um.size(); ++n) {
        const double expected = air.radiance[n] + air.transmittance[n] * planck(window_um[n], top);
        CAPTURE(eye_km, slant, window_um[n]);
        CHECK(seen.radiance[n] == Approx(expected).epsilon(2e-3));
        CHECK(seen.transmittance[n] == 0.0);
    }
}

TEST_CASE("a line through broken cloud is the mean of one through cloud and one through a gap",
          "[materials][cloud]") {
    const SightLine line = chord(3.0, 0.1, 4.0);
    const auto none = path_at_nodes(cloudy(0.0), line, window_um);
    const auto half = path_at_nodes(cloudy(0.5), line, window_um);
    const auto full = path_at_nodes(cloudy(1.0), line, window_um);
    for (std::size_t n = 0; n < window_um.size(); ++n) {
        CHECK(half.radiance[n] ==
              Approx(0.5 * (none.radiance[n] + full.radiance[n])).epsilon(2e-3));
        CHECK(half.transmittance[n] == Approx(0.5 * none.transmittance[n]).epsilon(1e-6));
    }
    // What a surface sends on of sun and sky is hidden like what it emits.
    const Atmosphere air = cloudy(0.5);
    const auto way = OnwardLight(air, 0.1, 30.0, window_um).way(line);
    for (std::size_t n = 0; n < window_um.size(); ++n) {
        CHECK(way.sunlight[n] < 0.55);
        CHECK(way.sky_heat[n] < 0.55);
    }
}

TEST_CASE("a cloud is no part of lines that stay below or above it", "[materials][cloud]") {
    for (const SightLine& line : {chord(0.0, 0.9, 3.0), chord(0.5, 0.5, 10.0), chord(5.0, 1.5, 4.0),
                                  sight_line(2.0, 60.0)}) {
        CHECK(!cloud_crossing(cloudy(1.0), line));
    }
    CHECK(cloud_crossing(cloudy(1.0), chord(0.0, 2.0, 3.0))->height_km == 1.0);
    CHECK(cloud_crossing(cloudy(1.0), chord(2.0, 0.0, 3.0))->height_km == 1.4);
    // An eye within sees it on either hand.
    CHECK(cloud_crossing(cloudy(1.0), chord(1.2, 0.0, 3.0))->height_km == 1.0);
    CHECK(cloud_crossing(cloudy(1.0), chord(1.2, 4.0, 3.0))->height_km == 1.4);
    CHECK(!cloud_crossing(cloudy(0.0), chord(2.0, 0.0, 3.0)));
}

TEST_CASE("a thick cloud's sunlit top is as bright as its closed-form albedo says",
          "[materials][cloud][sun_field]") {
    // Conservative drops, g = 0.85: albedo (1 − g) τ s / (2 + (1 − g) τ s), s = 1 to √3, in dry and
    // nearly clear air at 0.85 µm, where neither gases nor molecules count; the ground is dark.
    const double depth = GENERATE(10.0, 30.0);
    BandModel model{.profile = afgl_profile("SAW"), .aerosol = "none"};
    model.cloud = {.fraction = 1.0, .base_km = 1.0, .optical_depth = depth};
    const std::vector<double> um = {0.86};
    const double zenith_deg = 53.0, cosine = std::cos(radians(zenith_deg));
    const SunField field(model, {.zenith_deg = zenith_deg, .ground_albedo = 0.0}, um);
    const double top = field.path(chord(3.0, 0.0, 3.0), 180.0, 0.0)[0];
    const double beam = field.flux(3.0).direct[0];
    const double albedo = std::numbers::pi * top / (beam * cosine);
    const auto closed = [&](double s) { return 0.15 * depth * s / (2.0 + 0.15 * depth * s); };
    CAPTURE(depth, albedo);
    CHECK(albedo > 0.97 * closed(1.0));
    CHECK(albedo < 1.03 * closed(std::sqrt(3.0)));
    // The ground below is hidden; from under the cloud it is not.
    CHECK(path_at_nodes(model, chord(3.0, 0.0, 3.0), um).transmittance[0] < 1e-4);
    CHECK(path_at_nodes(model, chord(0.9, 0.0, 0.9), um).transmittance[0] > 0.95);
}

TEST_CASE("an object behind a thick cloud looks like the sky beside it", "[materials][cloud]") {
    const std::vector<double> node_um = {0.55, 0.87, 1.6, 2.1, 3.7};
    BandModel model = cloudy(1.0);
    model.cloud.optical_depth = 40.0;
    model.scale.diffuse = GENERATE(1.0, 1.3);
    const SunField field(model, {.zenith_deg = 30.0}, node_um);
    const double zenith_deg = GENERATE(0.0, 50.0);
    const double range = 2.5 / std::cos(radians(zenith_deg));
    const auto sky = field.sky(0.01, zenith_deg, 90.0);
    const auto before = field.path(chord(0.01, 2.51, range), zenith_deg, 90.0);
    const SunFlux above = field.flux(60.0);
    for (std::size_t n = 0; n < node_um.size(); ++n) {
        CAPTURE(zenith_deg, node_um[n]);
        CHECK(before[n] == Approx(sky[n]).epsilon(0.02));
        CHECK(std::numbers::pi * before[n] < above.direct[n]);
    }
}

TEST_CASE("light is the cloud's up to its top, and the clear sky's above", "[materials][cloud]") {
    const std::vector<double> node_um = {0.6};
    BandModel model = cloudy(1.0);  // base 1 km, top 1.4 km
    model.cloud.optical_depth = 30.0;
    model.scale = {.beam = 1.0, .diffuse = 1.1};
    const SunField field(model, {.zenith_deg = 30.0}, node_um);
    const SunField clear(cloudy(0.0), {.zenith_deg = 30.0}, node_um);
    CHECK(field.flux(1.39).direct[0] < 1e-6);
    CHECK(field.flux(1.39).down[0] == Approx(field.flux(1.0).down[0]).epsilon(1e-4));
    CHECK(field.flux(1.41).direct[0] == Approx(clear.flux(1.41).direct[0]).epsilon(1e-9));
    // A bright cloud below sends light back into the sky: more than the clear sky's, by little.
    CHECK(field.flux(1.41).down[0] > clear.flux(1.41).down[0]);
    CHECK(field.flux(1.41).down[0] < 0.3 * field.flux(1.41).direct[0]);
    CHECK(solar_at_nodes(Atmosphere(model), 1.39, 30.0, 1.0, node_um)[0] < 1e-6);
    CHECK(solar_at_nodes(Atmosphere(model), 1.41, 30.0, 1.0, node_um)[0] ==
          Approx(field.flux(1.41).direct[0]).epsilon(1e-6));
}
