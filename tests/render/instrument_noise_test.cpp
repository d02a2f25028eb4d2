#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "materials/base/parallel.hpp"
#include "render/instrument/draws.hpp"
#include "render/instrument/presets.hpp"
#include "tests/support/camera_series.hpp"

using namespace diurna;
using namespace diurna::testing;
using std::numbers::pi;

TEST_CASE("shot noise has the variance of its mean", "[render][instrument][by_replication]") {
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

TEST_CASE("NETD measured over 100 frames is the one computed",
          "[render][instrument][by_replication]") {
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

TEST_CASE("NETD given is the one measured", "[render][instrument][by_replication]") {
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

TEST_CASE("kTC noise is that of a capacitor at its temperature",
          "[render][instrument][by_replication]") {
    // Janesick, Scientific Charge-Coupled Devices (2001), 6.2: 400 √C[pF] electrons at 300 K.
    CHECK(reset_noise(300.0, 1e-12) == Approx(400.0).epsilon(0.02));
    CHECK(reset_noise(300.0, 0.1e-12) == Approx(126.0).epsilon(0.02));
}

TEST_CASE("the components of three-dimensional noise are found as put in",
          "[render][instrument][by_replication]") {
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
          "[render][instrument][by_replication]") {
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

TEST_CASE("1/f noise has as much power in every octave", "[render][instrument][by_replication]") {
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
          "[render][instrument][by_replication]") {
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

TEST_CASE("in the dark a picture has its mean at the black level and all its noise",
          "[render][instrument][by_replication]") {
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
