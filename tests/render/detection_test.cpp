#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <utility>

#include "materials/radiation/band.hpp"
#include "render/detection/eye.hpp"
#include "render/detection/ranges.hpp"
#include "render/detection/resolvable.hpp"
#include "render/detection/task_metric.hpp"
#include "render/detection/tasks.hpp"

using namespace diurna;
using std::numbers::pi;

namespace {

Imager imager_with(const std::function<double(double)>& mtf) {
    return {.mtf_right = mtf, .mtf_down = mtf, .pixel = 0.1, .netd = 0.05, .frame_rate = 30.0};
}

/// What MRT is over f/MTF, by Lloyd's coefficient π²/(4 √14) for a noise bandwidth of half the
/// pixels' rate, with 2.25 and 0.2 s.
double bar_slope(const Imager& imager) {
    return 2.25 * 0.659442 * std::sqrt(2.0) * imager.netd * imager.pixel /
           std::sqrt(0.2 * imager.frame_rate);
}

}  // namespace

TEST_CASE("the target transfer function is the published table",
          "[render][detection][by_comparison]") {
    // Multiples of N50 and probabilities of Ratches and others (ECOM-7043, 1975), as Holst and
    // ACQUIRE's guide print them, to two digits.
    const std::array<std::pair<double, double>, 7> table{{{3.0, 1.0},
                                                          {2.0, 0.95},
                                                          {1.5, 0.80},
                                                          {1.0, 0.50},
                                                          {0.75, 0.30},
                                                          {0.5, 0.10},
                                                          {0.25, 0.02}}};
    for (const auto& [multiple, probability] : table) {
        CAPTURE(multiple);
        CHECK(johnson_probability(4.0 * multiple, 4.0) == Approx(probability).margin(0.021));
    }
    CHECK(johnson_probability(0.0, 4.0) == 0.0);
    CHECK(johnson_probability(1e200, 4.0) == 1.0);  // no infinity over another
    CHECK(johnson_probability(2.0, 1.0) == Approx(std::pow(2.0, 4.1) / (1 + std::pow(2.0, 4.1))));
    CHECK(ttp_probability(2.0, 1.0) == Approx(std::pow(2.0, 1.99) / (1 + std::pow(2.0, 1.99))));
    for (const double probability : {0.1, 0.5, 0.9}) {
        CHECK(johnson_probability(johnson_ratio(probability), 1.0) == Approx(probability));
        CHECK(ttp_probability(ttp_ratio(probability), 1.0) == Approx(probability));
    }
}

TEST_CASE("the eye's threshold is that of Barten's formula", "[render][detection][by_comparison]") {
    // Sensitivities as sums on paper of the form of 1990; 10 and 100 cd/m2, 15 and 10 degrees.
    const std::array<double, 6> cycles{0.5, 1.0, 2.0, 5.0, 10.0, 20.0};
    const std::array<double, 6> dim{140.26, 249.81, 374.15, 343.49, 161.57, 35.04};
    const std::array<double, 6> bright{125.55, 240.25, 409.00, 501.19, 297.06, 93.77};
    for (std::size_t i = 0; i < cycles.size(); ++i) {
        CAPTURE(cycles[i]);
        const double per_mrad = cycles[i] * 180.0 / pi / 1000.0;
        CHECK(1.0 / contrast_threshold(per_mrad, 10.0, 15.0) == Approx(dim[i]).epsilon(1e-4));
        CHECK(1.0 / contrast_threshold(per_mrad, 100.0, 10.0) == Approx(bright[i]).epsilon(1e-4));
    }
    // A small field counts as in Barten's formula of 2003, Proc. SPIE 5294, eq. 3: by its width.
    const double per_mrad = 0.1 * 180.0 / pi / 1000.0;
    CHECK(contrast_threshold(per_mrad, 100.0, 0.01) / contrast_threshold(per_mrad, 100.0, 0.02) ==
          Approx(2.0).epsilon(0.01));
    CHECK(contrast_threshold(100.0, 34.0, 15.0) > 1.0);  // far too fine, no NaN
    CHECK(eye_mtf(0.0, 3.0) == 1.0);
    CHECK(pupil_diameter_mm(3.4262591e2) == Approx(3.0));  // 100 fL
}

TEST_CASE("bars through a Gaussian are resolved where Lambert's W says",
          "[render][detection][by_comparison]") {
    // f e^(2π²s²f²) = ΔT/k is u e^u = (2π s ΔT/k)² of u = (2π s f)²: W(e) = 1, W(2 e²) = 2,
    // W(1) = 0.56714329.
    const double s = 0.06;  // [mrad]
    const Imager imager =
        imager_with([s](double f) { return std::exp(-2.0 * pi * pi * s * s * f * f); });
    const double k = bar_slope(imager);
    for (const double u : {0.56714329, 1.0, 2.0}) {
        const double difference = k * std::sqrt(u * std::exp(u)) / (2.0 * pi * s);
        CAPTURE(u);
        CHECK(resolved_frequency(difference, imager) ==
              Approx(std::sqrt(u) / (2.0 * pi * s)).epsilon(1e-5));
    }
    CHECK(resolved_frequency(1e9, imager) == imager.finest());
    CHECK(resolved_frequency(0.0, imager) < 1e-9);
    // Twice the noise is twice the difference; four times the frames half of it.
    Imager other = imager;
    other.netd *= 2.0;
    CHECK(resolvable_difference(2.0, 0.4, other) ==
          Approx(2.0 * resolvable_difference(2.0, 0.4, imager)));
    other = imager;
    other.frame_rate *= 4.0;
    CHECK(resolvable_difference(2.0, 0.4, other) ==
          Approx(0.5 * resolvable_difference(2.0, 0.4, imager)));
}

TEST_CASE("ranges of an exponential MRT through even air are a closed form",
          "[render][detection][by_comparison]") {
    // MRT = m e^(κ f) against ΔT e^(−σ R) with f = N R/h: R = ln(ΔT/m)/(σ + κ N/h), the range of
    // STANAG 4347's target (2.3 m, 2 K; 0.2 and 1.0 per km of good and limited air).
    const double m = 0.02, kappa = 0.6;
    Imager imager = imager_with({});
    const double k = bar_slope(imager);
    imager.mtf_right =
        imager.mtf_down = [=](double f) { return k * f / (m * std::exp(kappa * f)); };
    imager.pixel = 0.1;
    for (const double per_km : {0.2, 1.0}) {
        for (const Task& task : tasks) {
            const double n = task.cycles_square, h = 2.3;
            const auto cycles = [&](double range) {
                return resolved_cycles(2.0 * std::exp(-per_km * range / 1000.0), h, range, imager);
            };
            CAPTURE(per_km, task.name);
            const double closed = std::log(2.0 / m) / (per_km / 1000.0 + kappa * n / (1000.0 * h));
            const double finest = h * 1000.0 * imager.finest() / n;  // what pixels allow
            CHECK(farthest_range(cycles, n, 10.0, 1e6) ==
                  Approx(std::min(closed, finest)).epsilon(1e-5));
        }
    }
    CHECK(farthest_range([](double r) { return 1.0 / r; }, 1.0, 10.0, 100.0) == 0.0);
    CHECK(farthest_range([](double r) { return 1e3 / r; }, 1.0, 10.0, 100.0) == 100.0);
}

TEST_CASE("the task metric of simple thresholds is a closed form",
          "[render][detection][by_comparison]") {
    SystemThreshold threshold{.step = 0.001, .right = {}, .down = {}};
    const Viewing viewing{.scene_contrast = 4.0};
    SECTION("even") {
        threshold.right.assign(5000, 0.01);
        threshold.down.assign(5000, 0.04);
        // √(C/c) f_end each way, C = 2/(2·4): √(5·5 · 5·2.5)
        CHECK(task_integral(0.25, threshold) == Approx(std::sqrt(25.0 * 12.5)));
        CHECK(task_metric(2.0, 3.0, 1500.0, threshold, viewing) ==
              Approx(2.0 * std::sqrt(25.0 * 12.5)));
        CHECK(task_integral(0.005, threshold) == 0.0);
    }
    SECTION("rising exponentially: 2/κ (√(C/c) − 1)") {
        const double c = 0.004, kappa = 1.3;
        for (int i = 0; i < 5000; ++i) {
            threshold.right.push_back(c * std::exp(kappa * (i + 0.5) * threshold.step));
        }
        threshold.down = threshold.right;
        CHECK(task_integral(0.25, threshold) ==
              Approx(2.0 / kappa * (std::sqrt(0.25 / c) - 1.0)).epsilon(1e-3));
    }
    SECTION("a display shows no more than all its contrast") {
        threshold.right.assign(5000, 0.01);
        threshold.down = threshold.right;
        CHECK(task_metric(1e3, 3.0, 1500.0, threshold, viewing) ==
              task_metric(8.0, 3.0, 1500.0, threshold, viewing));
    }
}

TEST_CASE("a threshold through lens, display and noise is their product", "[render][detection]") {
    Imager imager = imager_with([](double) { return 0.5; });
    imager.netd = 0.0;
    Viewing viewing{.magnification = 1e3};  // so large that the eye blurs no noise
    const SystemThreshold clear = system_threshold(imager, viewing, 100);
    const std::size_t at = 3;
    const double f = 3.5 * clear.step;
    const double x = pi * f * imager.pixel;
    const double eye = contrast_threshold(f / 1e3, viewing.luminance, viewing.display_deg);
    CHECK(clear.right[at] == Approx(eye / (0.5 * std::sin(x) / x)));

    // Much noise: α √S √(Q_along Q_across)/K. Of square display pixels ∫ sinc² = 1/δ across; along,
    // where these blur little, 2 f ∫ e^(−4.4 ln² x) dx = 2 f √(π/4.4) e^(1/17.6).
    imager.netd = 100.0;
    const SystemThreshold noisy = system_threshold(imager, viewing, 100);
    const double density = 100.0 * 100.0 * 0.1 * 0.1 / 30.0;
    const double along = 2.0 * f * std::sqrt(pi / 4.4) * std::exp(1.0 / 17.6);
    const double expected = 169.6 * std::sqrt(density * along / 0.1) / viewing.scene_contrast;
    CHECK(noisy.right[at] / clear.right[at] == Approx(expected).epsilon(0.01));
}

TEST_CASE("an instrument's lens and pixels in angles", "[render][detection]") {
    Instrument instrument;
    instrument.lens.f_number = 4.0;
    instrument.detector.pitch = 15e-6;
    instrument.detector.netd = 0.2;
    const Imager imager = imager_of(instrument, parse_band("9.99-10.01"), 0.1);
    CHECK(imager.pixel == Approx(0.15));
    CHECK(imager.netd == Approx(0.2));
    CHECK(imager.finest() == Approx(1.0 / 0.3));
    const double f = 1.5, nu = f * 1e4 * 10e-6 * 4.0, x = pi * f * 0.15;
    const double lens = 2.0 / pi * (std::acos(nu) - nu * std::sqrt(1.0 - nu * nu));
    CHECK(imager.mtf_right(f) == Approx(lens * std::sin(x) / x).epsilon(1e-3));
    CHECK(imager.mtf_down(f) == imager.mtf_right(f));
}
