#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/atmosphere/ground_fluxes.hpp"
#include "materials/atmosphere/sun_field.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/incident_light.hpp"
#include "render/light/radiance.hpp"
#include "tests/support/render_scene.hpp"

using namespace diurna;

// Two ways through the code to one light: ground_fluxes() for the heat balance, incident_light()
// for what a surface reflects into the camera.
TEST_CASE("solver and camera receive the same light from one air, clouds included",
          "[materials][render][flux]") {
    const double cover = GENERATE(0.0, 0.6, 1.0);
    BandModel air{.profile = afgl_profile("MLS"), .aerosol = "rural", .ground_km = 0.3};
    air.cloud = {.fraction = cover, .base_km = 1.8, .optical_depth = 8.0};
    constexpr double height_km = 0.3;
    const SunLight sun{.zenith_deg = 40.0, .distance_au = 1.01};
    const GroundFluxes flux = ground_fluxes(air, sun, height_km);

    const FacetSet facets;
    const FacetViews sky_view;
    const MaterialLibrary materials({testing::material("grey", flat_spectrum(0.3))});
    const std::vector<float> lit = {1.0f};
    const RadianceInput input{.facets = facets,
                              .views = sky_view,
                              .materials = materials,
                              .atmosphere = air,
                              .temperature = {},
                              .sun_fraction = lit,
                              .sun_zenith_deg = sun.zenith_deg,
                              .sun_distance_au = sun.distance_au,
                              .ground_height_km = height_km};
    CAPTURE(cover);
    const Band solar = flat_band("sun", 0.3, 5.0, bin_edges_um(), 1);
    const auto scattered = scattered_sun(input, solar.node_um);
    REQUIRE(scattered);
    const IncidentLight with = incident_light(input, height_km, solar.node_um, &*scattered);
    const IncidentLight without = incident_light(input, height_km, solar.node_um, nullptr);
    CHECK(band_sum_nodes(solar, with.sun) == Approx(flux.sun_direct).epsilon(1e-4));
    const double diffuse =
        std::numbers::pi * (band_sum_nodes(solar, with.sky) - band_sum_nodes(solar, without.sky)) +
        band_sum_nodes(solar, with.aureole) * std::cos(radians(sun.zenith_deg));
    CHECK(diffuse == Approx(flux.sun_diffuse).epsilon(1e-6));

    // Eight angles here, four there; beyond 28 um both have the air near by.
    const Band thermal = flat_band("thermal", 3.5, 100.0, bin_edges_um(), 2);
    IncidentLight heat = incident_light(input, height_km, thermal.node_um, nullptr);
    const double near_by = air_at(air.profile, height_km).temperature;
    for (std::size_t n = 0; n < heat.sky.size(); ++n) {
        if (thermal.node_um[n] > 28.0) heat.sky[n] = planck(thermal.node_um[n], near_by);
    }
    CHECK(std::numbers::pi * band_sum_nodes(thermal, heat.sky) ==
          Approx(flux.thermal).epsilon(2e-3));
    // Clouds of the air's own temperature bring the sky closer to it, and hide the sun.
    if (cover == 1.0) {
        CHECK(flux.sun_direct < 0.01 * solar_constant);
        CHECK(flux.thermal > 0.9 * stefan_boltzmann * std::pow(near_by - 9.0, 4));
    }
}
