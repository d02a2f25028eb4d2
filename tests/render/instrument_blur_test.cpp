#include <catch2/catch.hpp>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "materials/base/error.hpp"
#include "render/instrument/distortion.hpp"
#include "render/instrument/mtf.hpp"
#include "tests/support/plain_camera.hpp"

using namespace diurna;
using namespace diurna::testing;
using std::numbers::pi;

namespace {

/// Every part of the chain: Boreman's and Holst's closed forms at one wavelength, times each other.
/// Written down here again; [cycles/m] in the picture's plane.
double chain(const Instrument& camera, double right, double down, double wavelength,
             double focal_length) {
    const double f = std::hypot(right, down), nu = f * wavelength * camera.lens.f_number;
    if (nu >= 1.0) return 0.0;
    const auto box = [](double x) { return x == 0.0 ? 1.0 : std::sin(pi * x) / (pi * x); };
    const double angle = std::acos(nu);
    const double lens = 2.0 / pi * (angle - std::cos(angle) * std::sin(angle));
    const double rms = camera.blur.wavefront_error / 0.18;
    const double aberration = 1.0 - rms * rms * (1.0 - 4.0 * (nu - 0.5) * (nu - 0.5));
    const double spread = 2.0 * pi * f * camera.blur.diffusion_length;
    const double shake = pi * f * camera.blur.jitter * focal_length;
    const double smear = (right * camera.blur.drift.x() + down * camera.blur.drift.y());
    const double side = camera.detector.pitch * std::sqrt(camera.detector.fill);
    return lens * aberration / (1.0 + spread * spread) * std::exp(-2.0 * shake * shake) *
           box(smear * focal_length) * box(right * side) * box(down * side);
}

Instrument shaky() {
    Instrument camera = plain_instrument();
    camera.detector.fill = 0.81;
    camera.blur.wavefront_error = 0.05;
    camera.blur.diffusion_length = 1e-6;
    camera.blur.jitter = 40e-6;
    camera.blur.drift = {80e-6, 0.0};
    return camera;
}

constexpr double focal_length = 0.05;

/// 4 µm: a band so narrow that one wavelength represents it.
Camera narrow_camera(const Instrument& instrument, int width, int height) {
    return camera_of(instrument, flat_band("4", 3.995, 4.005), width, height, focal_length);
}

/// MTF of an edge's picture by ISO 12233: pixels by their distance from it in bins of a quarter,
/// the slope of these, its Fourier transform over what bins and differences take.
///
/// - from: [pixels] the edge crosses the upper border at; slope: columns a row
double edge_mtf(const std::vector<float>& picture, int width, int height, double from, double slope,
                double cycles_per_pixel) {
    constexpr int parts = 4, reach = 40;
    std::vector<double> sum(2 * reach * parts, 0.0), count(2 * reach * parts, 0.0);
    const double cosine = 1.0 / std::hypot(1.0, slope);
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            const double away = (column + 0.5 - from - slope * (row + 0.5)) * cosine;
            const int bin = static_cast<int>(std::floor((away + reach) * parts));
            if (bin < 0 || bin >= 2 * reach * parts) continue;
            sum[std::size_t(bin)] += double(picture[std::size_t(row * width + column)]);
            count[std::size_t(bin)] += 1.0;
        }
    }
    std::complex<double> at = 0.0, total = 0.0;
    for (std::size_t b = 1; b + 1 < sum.size(); ++b) {
        const double rise = sum[b + 1] / count[b + 1] - sum[b - 1] / count[b - 1];
        at += rise * std::polar(1.0, -2.0 * pi * cycles_per_pixel * double(b) / parts);
        total += rise;
    }
    const double bins = sinc(cycles_per_pixel / parts),
                 steps = sinc(2.0 * cycles_per_pixel / parts);
    return std::abs(at / total) / (bins * steps);
}

}  // namespace

TEST_CASE("a slanted edge shows the product of the closed-form MTFs", "[render][instrument]") {
    const bool with_all = GENERATE(false, true);
    const Instrument instrument = with_all ? shaky() : plain_instrument();
    const int width = 128, height = 160;
    const Camera camera = narrow_camera(instrument, width, height);
    CAPTURE(with_all, camera.oversampling.times);
    const double slope = std::tan(5.0 * pi / 180.0), from = 0.5 * width - slope * 0.5 * height;
    const auto covered = [&](double x, double y, double side) {
        double share = 0.0;  // of a square right of the edge, in thin rows
        for (int i = 0; i < 16; ++i) {
            const double edge = from + slope * (y + side * (i + 0.5) / 16.0);
            share += std::clamp((x + side - edge) / side, 0.0, 1.0) / 16.0;
        }
        return 1.0 + share;
    };
    const std::vector<float> picture = see(camera, oversampled(camera, covered));
    const double cosine = 1.0 / std::hypot(1.0, slope), sine = -slope * cosine;
    for (const double f : {0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7}) {  // cycles a pixel
        const double per_metre = f / instrument.detector.pitch;
        const double expected =
            chain(instrument, per_metre * cosine, per_metre * sine, 4e-6, focal_length);
        CAPTURE(f);
        CHECK(edge_mtf(picture, width, height, from, slope, f) == Approx(expected).margin(0.01));
    }
}

TEST_CASE("bars and waves keep the share of contrast that the MTF says", "[render][instrument]") {
    const Instrument instrument = shaky();
    const int width = 128, height = 8;
    const Camera camera = narrow_camera(instrument, width, height);
    const bool bars = GENERATE(true, false);
    // Waves of 1.25 pixels are finer than pixels resolve: they come back as waves of 4.9, as weak.
    // Of bars of 6.4 pixels the 31st harmonic is the first to come back as the first.
    const double period = bars ? 6.4 : GENERATE(6.4, 128.0 / 51.0, 128.0 / 102.0);
    CAPTURE(bars, period);
    const auto target = [&](double x, double, double side) {
        if (!bars) {
            return 1.0 + 0.5 * std::cos(2.0 * pi * (x + 0.5 * side) / period) * sinc(side / period);
        }
        double share = 0.0;  // exact: light where x / period is in its first half
        const auto light_to = [&](double at) {
            const double turns = std::floor(at / period), rest = at - turns * period;
            return turns * 0.5 * period + std::min(rest, 0.5 * period);
        };
        share = (light_to(x + side) - light_to(x)) / side;
        return 0.5 + share;
    };
    const std::vector<float> picture = see(camera, oversampled(camera, target));
    std::complex<double> wave = 0.0;
    double mean = 0.0;
    for (int column = 0; column < width; ++column) {
        const double value = double(picture[std::size_t(4 * width + column)]) / width;
        mean += value;
        wave += value * std::polar(1.0, -2.0 * pi * (column + 0.5) / period);
    }
    // A square wave's first harmonic is 4/π of it.
    const double contrast = bars ? 0.5 * 4.0 / pi : 0.5;
    const double expected = contrast * chain(instrument, 1.0 / (period * instrument.detector.pitch),
                                             0.0, 4e-6, focal_length);
    CHECK(2.0 * std::abs(wave) / mean == Approx(expected).epsilon(0.01));
}

TEST_CASE("a lens without errors has Goodman's diffraction-limited MTF", "[render][instrument]") {
    // Goodman, Introduction to Fourier Optics, 6.3: half the cut-off leaves 2/π (π/3 − √3/4).
    CHECK(diffraction_mtf(0.5) == Approx(2.0 / pi * (pi / 3.0 - std::sqrt(3.0) / 4.0)));
    CHECK(diffraction_mtf(0.0) == Approx(1.0));
    CHECK(diffraction_mtf(1.0) == 0.0);
    // Hopkins' integral without defocus is the same; Simpson against the closed form.
    for (const double nu : {0.1, 0.5, 0.9}) {
        CHECK(defocused_mtf(nu, 1e-9) == Approx(diffraction_mtf(nu)).margin(1e-6));
    }
    // A quarter wave at the edge: the Strehl ratio sinc²(W20/λ) = 0.81 is the MTF's volume over
    // that of the lens without errors (Born & Wolf 9.1), ∫ MTF ν dν.
    double with = 0.0, without = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const double nu = (i + 0.5) / 2000.0;
        with += defocused_mtf(nu, 0.25) * nu;
        without += diffraction_mtf(nu) * nu;
    }
    CHECK(with / without == Approx(std::pow(std::sin(0.25 * pi) / (0.25 * pi), 2)).epsilon(1e-4));
}

TEST_CASE("turbulence's MTF is Fried's, and its r0 that of a spherical wave",
          "[render][instrument][by_comparison]") {
    // exp(-3.44) where the lens would be one r0 wide (Fried 1966).
    CHECK(turbulence_mtf(0.1 / 4e-6, 4e-6, 0.1) == Approx(std::exp(-3.44)));
    // Andrews & Phillips, Laser Beam Propagation through Random Media (2005), 6.4: r0 = 2.1 rho0,
    // rho0 = (0.55 Cn2 k2 R)^(-3/5); their constants have two digits.
    const double k = 2.0 * pi / 0.5e-6;
    CHECK(fried_length(0.5e-6, 1e-14, 2000.0) ==
          Approx(2.1 * std::pow(0.55 * 1e-14 * k * k * 2000.0, -0.6)).epsilon(0.01));
}

TEST_CASE("an even picture stays even through any blur and distortion", "[render][instrument]") {
    Instrument instrument = shaky();
    instrument.lens.k1 = -0.2;
    instrument.lens.p1 = 0.01;
    instrument.lens.veiling_glare = 0.05;
    instrument.oversampling = GENERATE(2, 3, 4, 5);
    const Camera camera = narrow_camera(instrument, 40, 30);
    const auto flux = see(camera, oversampled(camera, [](double, double, double) { return 2.0; }));
    for (const float value : flux) {
        REQUIRE(double(value) == Approx(2.0 * camera.response.per_radiance).epsilon(1e-5));
    }
}

TEST_CASE("distortion is turned back, and moves points as Brown's law says",
          "[render][instrument]") {
    const Lens lens{.k1 = -0.25, .k2 = 0.08, .k3 = -0.01, .p1 = 0.002, .p2 = -0.001};
    for (const double x : {-0.4, 0.0, 0.3}) {
        for (const double y : {-0.3, 0.1}) {
            const Eigen::Vector2d there = distorted(lens, {x, y});
            CHECK((undistorted(lens, there) - Eigen::Vector2d(x, y)).norm() < 1e-11);
        }
    }
    CHECK(distorted({.k1 = -0.25}, {0.4, 0.0}).x() == Approx(0.4 * (1.0 - 0.25 * 0.16)));
    CHECK_THROWS_AS(undistorted({.k1 = -1.0}, {0.9, 0.0}), InputError);
    // A dot 40 pixels right of the axis appears where the law puts it.
    Instrument instrument = plain_instrument();
    instrument.lens.k1 = -200.0;  // of (40 · 15 µm / 50 mm)² = 1.44e-4: 2.9 % inward
    const Camera camera = narrow_camera(instrument, 128, 16);
    const auto flux = see(camera, oversampled(camera, [](double x, double, double) {
                              return std::exp(-0.5 * std::pow((x - 104.0) / 2.0, 2));
                          }));
    double sum = 0.0, moment = 0.0;
    for (int column = 0; column < 128; ++column) {
        const double value = double(flux[std::size_t(8 * 128 + column)]);
        sum += value;
        moment += value * (column + 0.5 - 64.0);
    }
    CHECK(moment / sum == Approx(40.0 * (1.0 - 200.0 * 1.44e-4)).margin(0.15));
}

TEST_CASE("a sharper lens needs more samples of radiance", "[render][instrument]") {
    Instrument sharp = plain_instrument();
    sharp.lens.f_number = 1.5;
    sharp.detector.fill = 0.5;
    Instrument blurred = sharp;
    blurred.blur.jitter = 3e-4;
    const Camera fine = narrow_camera(sharp, 16, 16), coarse = narrow_camera(blurred, 16, 16);
    CHECK(fine.oversampling.times > coarse.oversampling.times);
    CHECK(coarse.oversampling.times == 2);
    CHECK(fine.oversampling.why.find("are aliased") != std::string::npos);
}
