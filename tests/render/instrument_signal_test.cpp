#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/instrument/count_calibration.hpp"
#include "render/instrument/presets.hpp"
#include "tests/support/camera_series.hpp"

using namespace diurna;
using namespace diurna::testing;
using std::numbers::pi;

TEST_CASE("electrons of a black body are its photons through lens and pixel",
          "[render][instrument][by_comparison]") {
    Instrument instrument = plain_instrument();
    const Camera camera = camera_for(instrument, 8, 8);
    const double temperature = GENERATE(250.0, 300.0, 400.0);
    const double time = instrument.detector.integration_time;
    CHECK(time * camera.response.black_body(temperature) ==
          Approx(electrons(instrument, temperature)).epsilon(1e-6));
    // The lens emits 1 − τ of a black body of its own.
    const double lens = electrons(instrument, instrument.lens.housing_temperature) / 0.9 * 0.1;
    CHECK(time * camera.response.lens == Approx(lens).epsilon(1e-6));
}

TEST_CASE("a lens and a scene of one temperature look like a black body", "[render][instrument]") {
    Instrument instrument = plain_instrument();
    instrument.lens.housing_temperature = 310.0;
    instrument.lens.vignetting = 0.4;
    instrument.lens.cold_stop = false;
    const Camera camera = camera_for(instrument);
    // Whatever mounts cut off is wall: without cos4 every pixel has the same.
    const auto flux = even_flux(camera, 310.0);
    for (std::size_t p = 0; p < flux.size(); ++p) {
        const double all =
            double(flux[p]) * double(camera.field.light[p]) + double(camera.field.background[p]);
        REQUIRE(all == Approx(camera.response.walls + camera.response.beside).epsilon(1e-6));
    }
    // The whole half-space: π over the lens' solid angle.
    CHECK(camera.response.walls + camera.response.beside ==
          Approx(camera.response.walls * (4.0 * 2.5 * 2.5 + 1.0)));
}

TEST_CASE("light falls off with the fourth power of the cosine", "[render][instrument]") {
    Instrument instrument = plain_instrument();
    instrument.lens.cos4 = true;
    const Camera camera = camera_of(instrument, flat_band("3-5", 3.0, 5.0), 201, 201, 0.003);
    const double corner = std::atan(100.0 * std::sqrt(2.0) * 15e-6 / 0.003);  // pixels' middles
    CHECK(double(camera.field.light[0]) == Approx(std::pow(std::cos(corner), 4)).epsilon(1e-6));
    CHECK(double(camera.field.light[100 * 201 + 100]) == Approx(1.0));
}

TEST_CASE("glare takes light from the picture and spreads it, no more", "[render][instrument]") {
    std::vector<float> light(1000, 1.0f);
    light[500] = 0.0f;  // ISO 9358: a black spot in a white field
    spread_glare(0.03, light);
    CHECK(double(light[500]) == Approx(0.03).epsilon(0.002));
    CHECK(moments_of(light).mean == Approx(0.999));
}

TEST_CASE("counts per kelvin are the slope of the signal's transfer",
          "[render][instrument][by_variation]") {
    const Instrument instrument = plain_instrument();
    const Camera camera = camera_for(instrument);
    const auto counts_at = [&](double temperature) {
        return moments_of(take(camera, even_flux(camera, temperature), 3, 0.0).counts).mean;
    };
    const double slope = (counts_at(302.0) - counts_at(298.0)) / 4.0;
    const double expected = 65535.0 / instrument.detector.well *
                            (electrons(instrument, 302.0) - electrons(instrument, 298.0)) / 4.0;
    CHECK(slope == Approx(expected).epsilon(0.005));
    const auto curve = calibration(camera, flat_band("3-5", 3.0, 5.0), 300.0, 302.0, 1.0);
    REQUIRE(curve.size() == 3);
    CHECK(curve[0].counts_per_K ==
          Approx(65535.0 / instrument.detector.well *
                 (electrons(instrument, 300.5) - electrons(instrument, 299.5)))
              .epsilon(1e-4));
    CHECK(calibration_csv(camera, curve)
              .rfind("temperature_K,radiance_W_m2_sr,signal_electrons,", 0) == 0);
    // And the way back.
    const Shot shot = take(camera, even_flux(camera, 301.0), 4, 0.0);
    const auto temperature = measured_temperature(camera, shot.measured, shot.integration_time);
    CHECK(moments_of(temperature).mean == Approx(301.0).margin(0.002));
}

TEST_CASE("a bright picture shortens the exposure until its well is not full",
          "[render][instrument]") {
    Instrument instrument = preset("visible");
    instrument.lens.cos4 = false;
    instrument.lens.vignetting = 0.0;
    const Camera camera = camera_of(instrument, flat_band("0.4-0.7", 0.4, 0.7), 64, 64, 0.05);
    const double bright = 1e3 * instrument.detector.well;  // a second
    const std::vector<float> flux(64 * 64, static_cast<float>(bright));
    const Shot shot = take(camera, flux, 1, 0.0);
    CHECK(shot.integration_time == Approx(0.8e-3).epsilon(1e-3));
    CHECK(shot.saturated == 0);
    const std::vector<float> dim(64 * 64, 100.0f);
    CHECK(take(camera, dim, 1, 0.0).integration_time == instrument.detector.integration_time);
    instrument.detector.well_share = 0.0;
    const Camera fixed = camera_of(instrument, flat_band("0.4-0.7", 0.4, 0.7), 64, 64, 0.05);
    CHECK(take(fixed, flux, 1, 0.0).saturated == 64 * 64);
}

TEST_CASE("each preset is a camera and lists the effects it omits", "[render][instrument]") {
    CHECK(preset_names().size() == 4);
    for (const std::string& name : preset_names()) {
        const bool light = name == "visible" || name == "swir";
        const Band band = name == "visible"       ? flat_band("v", 0.4, 0.7)
                          : name == "swir"        ? flat_band("s", 0.9, 1.7)
                          : name == "cooled_mwir" ? flat_band("m", 3.0, 5.0)
                                                  : flat_band("l", 8.0, 14.0);
        const Camera camera = camera_of(preset(name), band, 32, 32, 0.05);
        const double netd = netd_at(300.0, camera.instrument, camera.response, camera.noise);
        CAPTURE(name, netd, camera.oversampling.why);
        if (name == "cooled_mwir") CHECK(netd < 0.025);
        if (name == "uncooled_lwir") CHECK(netd == Approx(0.045).epsilon(1e-6));
        CHECK(!left_out(camera.instrument).empty());
        CHECK((light || signal_of(300.0, camera.instrument, camera.response) > 0.0));
    }
    CHECK_THROWS_WITH(preset("cooled_mwr"), Catch::Contains("unknown instrument"));
}
