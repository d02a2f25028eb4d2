#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/instrument/camera.hpp"
#include "render/instrument/optics.hpp"
#include "tests/support/camera_series.hpp"

using namespace diurna;
using namespace diurna::testing;
using std::numbers::pi;

TEST_CASE("a two-point correction leaves what is bent, nothing else", "[render][instrument]") {
    Instrument instrument = plain_instrument();
    Detector& detector = instrument.detector;
    detector.shot_noise = false;
    detector.gain_spread = 0.05;
    detector.offset_spread = 30e3;
    instrument.lens.vignetting = 0.2;
    instrument.lens.narcissus = 0.01;
    instrument.correction.kind = CorrectionKind::two_point;
    instrument.correction.temperature = {290.0, 320.0};
    const auto error_at = [&](const Camera& camera, double temperature, double hours) {
        std::vector<double> error;
        const Shot shot = take(camera, even_flux(camera, temperature), 5, hours);
        for (const float value : shot.measured) {
            error.push_back(double(value) - signal_of(temperature, instrument, camera.response));
        }
        return error;
    };
    SECTION("straight answers: nothing") {
        const Camera camera = camera_for(instrument);
        const double n = signal_of(305.0, instrument, camera.response);
        CHECK(moments_of(error_at(camera, 305.0, 0.0)).deviation < 1e-6 * n);
        CHECK(std::abs(moments_of(error_at(camera, 350.0, 0.0)).mean) < 1e-6 * n);
    }
    SECTION("bent ones: nought at both points, a parabola between") {
        instrument.lens.vignetting = instrument.lens.narcissus = 0.0;
        detector.nonlinearity = 0.02;
        const Camera camera = camera_for(instrument);
        const auto n = [&](double t) { return signal_of(t, instrument, camera.response); };
        for (const double t : {290.0, 305.0, 320.0}) {
            const std::vector<double> error = error_at(camera, t, 0.0);
            for (std::size_t p = 0; p < error.size(); p += 37) {
                const double curve = double(camera.pattern.curve[p]) / detector.well;
                const double expected = curve * (n(t) - n(290.0)) * (n(320.0) - n(t)) /
                                        (1.0 - curve * (n(290.0) + n(320.0)));
                REQUIRE(error[p] == Approx(expected).margin(2e-6 * n(t)));
            }
        }
    }
    SECTION("drift since then: as much as has drifted") {
        instrument.lens.vignetting = instrument.lens.narcissus = 0.0;
        detector.offset_drift = 500.0;
        detector.gain_spread = 0.0;
        const Camera camera = camera_for(instrument);
        CHECK(moments_of(error_at(camera, 305.0, 0.5)).deviation == Approx(250.0).epsilon(0.05));
    }
    SECTION("one point takes offsets away, not gains") {
        instrument.lens.vignetting = instrument.lens.narcissus = 0.0;
        instrument.correction.kind = CorrectionKind::one_point;
        const Camera camera = camera_for(instrument);
        const double step = signal_of(305.0, instrument, camera.response) -
                            signal_of(290.0, instrument, camera.response);
        CHECK(moments_of(error_at(camera, 305.0, 0.0)).deviation ==
              Approx(0.05 * step).epsilon(0.05));
    }
    SECTION("narcissus comes back when the lens is warmer than at the correction") {
        instrument.lens.vignetting = 0.0;
        detector.gain_spread = 0.0;
        instrument.lens.housing_temperature = 305.0;
        instrument.correction.housing_temperature = 295.0;
        detector.temperature = 77.0;
        const Camera camera = camera_for(instrument);
        const std::vector<float> shown = take(camera, even_flux(camera, 305.0), 5, 0.0).measured;
        const double middle = double(shown[32 * 64 + 32]), corner = double(shown[0]);
        // 1 % of what walls of 305 K send beyond those of 295 K, e^-(1/0.4)^2 in the corner.
        const double walls =
            (electrons(instrument, 305.0) - electrons(instrument, 295.0)) / 0.9 * 0.01;
        CHECK(corner - middle == Approx(walls * (1.0 - std::exp(-6.25))).epsilon(0.01));
    }
}

TEST_CASE("a bolometer follows a step by its time constant", "[render][instrument]") {
    const std::vector<float> before = {1.0f, 1.0f};
    std::vector<float> now = {3.0f, 1.0f};
    // Straight from 1 to 3 in one time constant, from rest: 1 + 2 (1 - (1 - 1/e)) = 1 + 2/e.
    lag(0.01, 0.01, before, before, now);
    CHECK(double(now[0]) == Approx(1.0 + 2.0 / std::exp(1.0)));
    CHECK(now[1] == 1.0f);
    // What has stood still fades by 1/e in one.
    std::vector<float> faded = {1.0f, 1.0f};
    const std::vector<float> shown = {2.0f, 1.0f};
    lag(0.01, 0.01, before, shown, faded);
    CHECK(double(faded[0]) == Approx(1.0 + 1.0 / std::exp(1.0)));
}

TEST_CASE("dead pixels are as many as said, and are replaced", "[render][instrument]") {
    Instrument instrument = plain_instrument();
    instrument.detector.dead = 0.01;
    const bool replaced = GENERATE(true, false);
    instrument.correction.replace_dead = replaced;
    const Camera camera = camera_for(instrument, 200, 200);
    const Shot shot = take(camera, even_flux(camera, 300.0), 1, 0.0);
    const double n = signal_of(300.0, instrument, camera.response);
    std::size_t off = 0;
    for (const float value : shot.measured) off += std::abs(double(value) - n) > 0.1 * n ? 1 : 0;
    if (replaced) {
        CHECK(off == 0);
        CHECK(shot.dead == 0);
    } else {
        CHECK(double(off) == Approx(400.0).margin(60.0));  // three sigma
        CHECK(shot.dead == off);
    }
}
