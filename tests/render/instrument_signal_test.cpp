#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "render/instrument/calibration.hpp"
#include "render/instrument/draws.hpp"
#include "render/instrument/presets.hpp"
#include "tests/support/plain_camera.hpp"

using namespace diurna;
using namespace diurna::testing;
using std::numbers::pi;

namespace {

constexpr double c = 299792458.0, h = 6.62607015e-34, k = 1.380649e-23;

/// Photons of a black body at wavelengths up to `um` [s⁻¹ m⁻² sr⁻¹]: the series of
/// 2c (kT/hc)³ ∫ u²/(eᵘ − 1) du from hc/λkT on.
double photons_to(double um, double temperature) {
    const double x = h * c / (um * 1e-6 * k * temperature);
    double sum = 0.0;
    for (int n = 1; n <= 60; ++n) {
        sum += std::exp(-n * x) * (x * x / n + 2.0 * x / (n * n) + 2.0 / (double(n) * n * n));
    }
    return 2.0 * c * std::pow(k * temperature / (h * c), 3) * sum;
}
double photons(double from_um, double to_um, double temperature) {
    return photons_to(to_um, temperature) - photons_to(from_um, temperature);
}

/// Electrons of the plain instrument before a black body: A Ω t τ QE times its photons.
double electrons(const Instrument& i, double temperature) {
    const double solid = pi / (4.0 * i.lens.f_number * i.lens.f_number + 1.0);
    return i.detector.pitch * i.detector.pitch * solid * i.detector.integration_time * 0.9 * 0.8 *
           photons(3.0, 5.0, temperature);
}

Camera camera_for(const Instrument& instrument, int width = 64, int height = 64) {
    return camera_of(instrument, flat_band("3-5", 3.0, 5.0), width, height, 0.05);
}

/// Pictures of one even light: (frame)(pixel).
std::vector<std::vector<float>> series(const Camera& camera, double temperature, int frames) {
    std::vector<std::vector<float>> all;
    for (int f = 0; f < frames; ++f) {
        all.push_back(take(camera, even_flux(camera, temperature), 1000 + f, 0.0).measured);
    }
    return all;
}

std::vector<double> mean_of(const std::vector<std::vector<float>>& all) {
    std::vector<double> mean(all[0].size(), 0.0);
    for (const auto& frame : all) {
        for (std::size_t p = 0; p < mean.size(); ++p) {
            mean[p] += double(frame[p]) / double(all.size());
        }
    }
    return mean;
}

/// Of each pixel over time, the mean over pixels (root mean square).
double temporal_noise(const std::vector<std::vector<float>>& all) {
    const std::vector<double> mean = mean_of(all);
    double squares = 0.0;
    for (const auto& frame : all) {
        for (std::size_t p = 0; p < mean.size(); ++p) {
            squares += std::pow(double(frame[p]) - mean[p], 2);
        }
    }
    return std::sqrt(squares / (double(all.size() - 1) * double(mean.size())));
}

}  // namespace

TEST_CASE("electrons of a black body are its photons through lens and pixel",
          "[render][instrument]") {
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

TEST_CASE("shot noise has the variance of its mean", "[render][instrument]") {
    Instrument instrument = plain_instrument();
    // 2 ms .. 20 ns: half a million electrons to some five.
    instrument.detector.integration_time = GENERATE(2e-3, 2e-6, 2e-8);
    const Camera camera = camera_for(instrument, 200, 200);
    const std::vector<float> flux = even_flux(camera, 300.0);
    const auto [mean, deviation] = moments_of(take(camera, flux, 7, 0.0).measured);
    const double expected = signal_of(300.0, instrument, camera.response);
    CAPTURE(expected);
    // 40 000 pixels: the variance to 0.7 % (one sigma; more where counts are few).
    CHECK(mean == Approx(expected).epsilon(5.0 / std::sqrt(expected * 40000.0)));
    CHECK(deviation * deviation == Approx(expected).epsilon(0.03));
}

TEST_CASE("NETD measured over 100 frames is the one computed", "[render][instrument]") {
    Instrument instrument = plain_instrument();
    instrument.detector.read_noise = 900.0;
    const Camera camera = camera_for(instrument);
    const auto at = series(camera, 300.0, 100);
    const double slope = (moments_of(mean_of(series(camera, 301.0, 20))).mean -
                          moments_of(mean_of(series(camera, 299.0, 20))).mean) /
                         2.0;
    const double measured = temporal_noise(at) / slope;
    // √(N + read²) over dN/dT, N with the lens' own electrons.
    const double n = electrons(instrument, 300.0) + electrons(instrument, 295.0) / 9.0;
    const double by_K = (electrons(instrument, 300.5) - electrons(instrument, 299.5));
    CHECK(measured == Approx(std::sqrt(n + 900.0 * 900.0) / by_K).epsilon(0.02));
    CHECK(netd_at(300.0, instrument, camera.response, camera.noise) ==
          Approx(std::sqrt(n + 900.0 * 900.0) / by_K).epsilon(1e-4));
}

TEST_CASE("NETD given is the one measured", "[render][instrument]") {
    Instrument instrument = preset("uncooled_lwir");
    instrument.lens.cos4 = false;
    instrument.lens.vignetting = 0.0;
    instrument.detector.row_noise = instrument.detector.column_noise = 0.0;
    instrument.detector.gain_spread = instrument.detector.blinking = 0.0;
    instrument.correction.kind = CorrectionKind::none;
    const Camera camera = camera_of(instrument, flat_band("8-14", 8.0, 14.0), 64, 64, 0.01);
    const double slope = moments_of(mean_of(series(camera, 300.5, 30))).mean -
                         moments_of(mean_of(series(camera, 299.5, 30))).mean;
    // 1/f noise is slow: its share of 15 of 45 mK shows in part within 100 frames.
    instrument.detector.flicker_noise = 0.0;
    const Camera white = camera_of(instrument, flat_band("8-14", 8.0, 14.0), 64, 64, 0.01);
    CHECK(temporal_noise(series(white, 300.0, 100)) / slope == Approx(0.045).epsilon(0.02));
    Instrument photon = plain_instrument();
    photon.detector.netd = 0.03;
    const Camera counting = camera_for(photon);
    const double by_K = electrons(photon, 300.5) - electrons(photon, 299.5);
    CHECK(temporal_noise(series(counting, 300.0, 100)) / by_K == Approx(0.03).epsilon(0.02));
    photon.detector.netd = 0.001;
    CHECK_THROWS_WITH(camera_for(photon), Catch::Contains("less than"));
}

TEST_CASE("kTC noise is that of a capacitor at its temperature", "[render][instrument]") {
    // Janesick, Scientific Charge-Coupled Devices (2001), 6.2: 400 √C[pF] electrons at 300 K.
    CHECK(reset_noise(300.0, 1e-12) == Approx(400.0).epsilon(0.02));
    CHECK(reset_noise(300.0, 0.1e-12) == Approx(126.0).epsilon(0.02));
}

TEST_CASE("the components of three-dimensional noise are found as put in", "[render][instrument]") {
    // D'Agostino & Webb (1991): averages over time, rows (v), columns (h); variances free of bias
    // as of an analysis of variance.
    Instrument instrument = plain_instrument();
    Detector& detector = instrument.detector;
    detector.shot_noise = false;
    detector.read_noise = 100.0;    // σ_tvh
    detector.row_noise = 30.0;      // σ_tv
    detector.column_noise = 40.0;   // σ_th
    detector.frame_noise = 50.0;    // σ_t
    detector.offset_spread = 80.0;  // σ_vh
    detector.row_offset = 60.0;     // σ_v
    detector.column_offset = 45.0;  // σ_h
    const std::size_t T = 100, V = 120, H = 120;
    const Camera camera = camera_for(instrument, int(H), int(V));
    const auto all = series(camera, 300.0, int(T));
    std::vector<double> t(T, 0.0), v(V, 0.0), hh(H, 0.0), tv(T * V, 0.0), th(T * H, 0.0),
        vh(V * H, 0.0);
    double mean = 0.0;
    const double nt = double(T), nv = double(V), nh = double(H);
    for (std::size_t i = 0; i < T; ++i) {
        for (std::size_t j = 0; j < V; ++j) {
            for (std::size_t l = 0; l < H; ++l) {
                const double x = double(all[i][j * H + l]);
                mean += x / (nt * nv * nh);
                t[i] += x / (nv * nh);
                v[j] += x / (nt * nh);
                hh[l] += x / (nt * nv);
                tv[i * V + j] += x / nh;
                th[i * H + l] += x / nv;
                vh[j * H + l] += x / nt;
            }
        }
    }
    double s_t = 0, s_v = 0, s_h = 0, s_tv = 0, s_th = 0, s_vh = 0, s_tvh = 0;
    for (const double x : t) s_t += std::pow(x - mean, 2) / (nt - 1);
    for (const double x : v) s_v += std::pow(x - mean, 2) / (nv - 1);
    for (const double x : hh) s_h += std::pow(x - mean, 2) / (nh - 1);
    for (std::size_t i = 0; i < T; ++i) {
        for (std::size_t j = 0; j < V; ++j) {
            s_tv += std::pow(tv[i * V + j] - t[i] - v[j] + mean, 2) / ((nt - 1) * (nv - 1));
        }
        for (std::size_t l = 0; l < H; ++l) {
            s_th += std::pow(th[i * H + l] - t[i] - hh[l] + mean, 2) / ((nt - 1) * (nh - 1));
        }
    }
    for (std::size_t j = 0; j < V; ++j) {
        for (std::size_t l = 0; l < H; ++l) {
            s_vh += std::pow(vh[j * H + l] - v[j] - hh[l] + mean, 2) / ((nv - 1) * (nh - 1));
            for (std::size_t i = 0; i < T; ++i) {
                s_tvh += std::pow(double(all[i][j * H + l]) - tv[i * V + j] - th[i * H + l] -
                                      vh[j * H + l] + t[i] + v[j] + hh[l] - mean,
                                  2) /
                         ((nt - 1) * (nv - 1) * (nh - 1));
            }
        }
    }
    const double tvh2 = s_tvh, tv2 = s_tv - tvh2 / nh, th2 = s_th - tvh2 / nv,
                 vh2 = s_vh - tvh2 / nt;
    const double t2 = s_t - tv2 / nv - th2 / nh - tvh2 / (nv * nh);
    const double v2 = s_v - tv2 / nt - vh2 / nh - tvh2 / (nt * nh);
    const double h2 = s_h - th2 / nt - vh2 / nv - tvh2 / (nt * nv);
    CHECK(std::sqrt(tvh2) == Approx(100.0).epsilon(0.003));
    CHECK(std::sqrt(tv2) == Approx(30.0).epsilon(0.03));  // 12 000 draws: 0.65 %, and what tvh
    CHECK(std::sqrt(th2) == Approx(40.0).epsilon(0.03));  // leaves in the mean of a row
    CHECK(std::sqrt(vh2) == Approx(80.0).epsilon(0.02));
    CHECK(std::sqrt(t2) == Approx(50.0).epsilon(0.22));  // 100 draws: 7 %, three sigma
    CHECK(std::sqrt(v2) == Approx(60.0).epsilon(0.20));  // 120 draws: 6.5 %
    CHECK(std::sqrt(h2) == Approx(45.0).epsilon(0.20));
}

TEST_CASE("fixed pattern over temporal noise is gain's spread times the signal over its root",
          "[render][instrument]") {
    Instrument instrument = plain_instrument();
    instrument.detector.gain_spread = 0.004;
    const Camera camera = camera_for(instrument, 100, 100);
    const auto all = series(camera, 300.0, 60);
    const double temporal = temporal_noise(all);
    const double fixed = std::sqrt(std::pow(moments_of(mean_of(all)).deviation, 2) -
                                   temporal * temporal / double(all.size()));
    const double n = signal_of(300.0, instrument, camera.response);
    CHECK(fixed / temporal == Approx(0.004 * std::sqrt(n)).epsilon(0.03));  // 0.7 % one sigma
}

TEST_CASE("counts per kelvin are the slope of the signal's transfer", "[render][instrument]") {
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

TEST_CASE("1/f noise has as much power in every octave", "[render][instrument]") {
    // Sums of 2 and 4, ... neighbours: the variance of their differences stays (Allan 1966), where
    // white noise loses half each time.
    const int n = 1 << 15;
    std::vector<double> series;
    for (int i = 0; i < n; ++i) series.push_back(flicker(3, 5, std::uint64_t(i)));
    std::vector<double> allan;
    for (int of = 4; of <= 64; of *= 4) {
        double sum = 0.0;
        int count = 0;
        for (int i = 0; i + 2 * of <= n; i += of) {
            double a = 0.0, b = 0.0;
            for (int j = 0; j < of; ++j) {
                a += series[std::size_t(i + j)] / of;
                b += series[std::size_t(i + of + j)] / of;
            }
            sum += 0.5 * (a - b) * (a - b);
            ++count;
        }
        allan.push_back(sum / count);
    }
    CHECK(allan[1] / allan[0] == Approx(1.0).epsilon(0.2));
    CHECK(allan[2] / allan[1] == Approx(1.0).epsilon(0.3));
    double squares = 0.0;
    for (std::uint64_t place = 0; place < 20000; ++place)
        squares += std::pow(flicker(3, place, 9), 2);
    CHECK(squares / 20000.0 == Approx(1.0).epsilon(0.03));
}

TEST_CASE("a frame alone is the frame in its sequence, on any number of threads",
          "[render][instrument]") {
    Instrument instrument = preset("cooled_mwir");
    const Camera camera = camera_for(instrument, 300, 100);
    const auto flux = even_flux(camera, 300.0);
    const Shot first = take(camera, flux, 41, 0.2), second = take(camera, flux, 42, 0.2);
    set_thread_count(1);
    const Shot alone = take(camera_for(instrument, 300, 100), flux, 42, 0.2);
    set_thread_count(0);
    CHECK(alone.counts == second.counts);
    CHECK(first.counts != second.counts);
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

TEST_CASE("in the dark a picture has its mean at the black level and all its noise",
          "[render][instrument]") {
    Instrument instrument = preset("visible");
    const Camera camera = camera_of(instrument, flat_band("0.4-0.7", 0.4, 0.7), 128, 128, 0.05);
    const Shot shot = take(camera, std::vector<float>(128 * 128, 0.0f), 1, 0.0);
    // Read noise, offsets, lines, and the counting of 0.15 electrons of dark current.
    const double dark = 5.0 * 0.03;
    const double expected = std::sqrt(2.4 * 2.4 + 1.0 + 0.3 * 0.3 * 3.0 + dark);
    const auto [mean, deviation] = moments_of(shot.measured);
    CHECK(mean == Approx(dark).margin(0.15));  // lines' own means: 0.3 over the root of 128
    CHECK(deviation == Approx(expected).epsilon(0.02));
    CHECK(moments_of(shot.counts).mean == Approx(64.0).margin(0.3));
}

TEST_CASE("each preset is a camera, and says what it leaves out", "[render][instrument]") {
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
    CHECK_THROWS_WITH(preset("cooled_mwr"), Catch::Contains("no instrument"));
}
