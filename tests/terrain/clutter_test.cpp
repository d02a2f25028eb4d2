#include "terrain/texture/clutter.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

using namespace diurna;

namespace {

/// A field on a square grid.
struct Sample {
    int n;
    double step;
    std::vector<double> value;

    Sample(const ClutterSpec& spec, int count, double apart, double spacing = 0.0)
        : n(count), step(apart), value(std::size_t(count) * std::size_t(count)) {
        const Clutter field(spec);
        for (int j = 0; j < n; ++j) {
            for (int i = 0; i < n; ++i) {
                value[std::size_t(j) * std::size_t(n) + std::size_t(i)] =
                    field.at(17.3 + i * step, -4711.1 + j * step, spacing);
            }
        }
    }
    double at(int i, int j) const {
        return value[std::size_t(j) * std::size_t(n) + std::size_t(i)];
    }
    /// Mean of the k-th power.
    double moment(int k) const {
        double sum = 0.0;
        for (const double v : value) sum += std::pow(v, k);
        return sum / double(value.size());
    }
    double correlation(int right, int up) const {
        double sum = 0.0;
        for (int j = 0; j + up < n; ++j) {
            for (int i = 0; i + right < n; ++i) sum += at(i, j) * at(i + right, j + up);
        }
        return sum / (double(n - right) * double(n - up)) / moment(2);
    }
    /// [m] where the correlation along an axis falls through 1/e.
    double length(bool along_x) const {
        double before = 1.0;
        for (int k = 1;; ++k) {
            const double here = along_x ? correlation(k, 0) : correlation(0, k);
            if (here < 1.0 / std::numbers::e) {
                // Straight in the logarithm from one lag to the next.
                const double part = (std::log(before) + 1.0) / (std::log(before) - std::log(here));
                return (k - 1 + part) * step;
            }
            before = here;
        }
    }
};

}  // namespace

TEST_CASE("clutter has the deviation and correlation length it is given",
          "[terrain][clutter][by_replication]") {
    const auto law = GENERATE(Covariance::exponential, Covariance::gaussian);
    const double length = GENERATE(0.8, 12.0);
    CAPTURE(law, length);
    // 300 lengths square: sampling leaves 0.3 % of the deviation and 1 % of the length.
    const Sample sample({.length = length, .covariance = law, .seed = 5}, 900, length / 3.0);
    CHECK(std::abs(sample.moment(1)) < 0.02);
    CHECK(std::sqrt(sample.moment(2)) == Approx(1.0).epsilon(0.02));
    CHECK(sample.length(true) == Approx(length).epsilon(0.05));
    CHECK(sample.length(false) == Approx(length).epsilon(0.05));
    // The same from every direction: 2 lengths away along a diagonal (6 √2 / 2 steps ~ 4 and 4).
    const double r = std::hypot(4.0, 4.0) / 3.0;
    const double wanted = law == Covariance::exponential ? std::exp(-r) : std::exp(-r * r);
    CHECK(sample.correlation(4, 4) == Approx(wanted).margin(0.02));
}

TEST_CASE("clutter is normally distributed", "[terrain][clutter]") {
    Sample sample({.length = 5.0, .covariance = Covariance::exponential, .seed = 11}, 800, 2.5);
    const double variance = sample.moment(2);
    // Of 160 000 nearly independent places: skewness and kurtosis to 0.02 and 0.04.
    CHECK(std::abs(sample.moment(3) / std::pow(variance, 1.5)) < 0.05);
    CHECK(sample.moment(4) / (variance * variance) == Approx(3.0).margin(0.1));
    // Kolmogorov and Smirnov: the greatest distance between the distributions.
    std::sort(sample.value.begin(), sample.value.end());
    double worst = 0.0;
    for (std::size_t i = 0; i < sample.value.size(); ++i) {
        const double p = 0.5 * std::erfc(-sample.value[i] / std::numbers::sqrt2);
        worst = std::max(worst, std::abs(p - (double(i) + 0.5) / double(sample.value.size())));
    }
    CHECK(worst < 0.01);
}

TEST_CASE("octaves add up to the exponential law", "[terrain][clutter][by_comparison]") {
    const auto octaves = clutter_octaves({.length = 4.0, .covariance = Covariance::exponential});
    const auto covariance = [&](double r) {
        double sum = 0.0;
        for (const auto& [length, variance] : octaves) {
            sum += variance * std::exp(-r * r / (length * length));
        }
        return sum;
    };
    CHECK(covariance(0.0) == Approx(1.0).epsilon(1e-12));
    for (double r = 0.5; r < 20.0; r += 0.25) {
        CAPTURE(r);
        CHECK(covariance(r) == Approx(std::exp(-r / 4.0)).margin(0.015));
    }
    CHECK(covariance(4.0) == Approx(1.0 / std::numbers::e).margin(0.002));
}

TEST_CASE("clutter is a function of seed and place", "[terrain][clutter][by_replication]") {
    const ClutterSpec spec{.length = 3.0, .seed = 7};
    const Clutter a(spec), b(spec), other({.length = 3.0, .seed = 8});
    double product = 0.0;
    for (int i = 0; i < 4000; ++i) {
        const double x = 13.7 * i, y = -29.1 * i;
        REQUIRE(a.at(x, y) == b.at(x, y));
        product += a.at(x, y) * other.at(x, y) / 4000.0;
    }
    CHECK(std::abs(product) < 4.0 / std::sqrt(4000.0));  // independent seeds, 4 sigma
    // It runs on across the origin and the borders of its cells.
    for (double x = -2.0; x < 2.0; x += 0.01) {
        REQUIRE(std::abs(a.at(x, 0.0) - a.at(x + 1e-6, 0.0)) < 2e-3);
    }
}

TEST_CASE("what is finer than the distance between samples averages away", "[terrain][clutter]") {
    // Over squares of side d the variance is the mean of the covariance between two of their
    // places: for exp(-r²/l²) the square of (√π x erf(x) - 1 + exp(-x²)) / x², x = d/l.
    const double x = GENERATE(0.5, 1.0, 2.0);
    const double mean =
        (std::sqrt(std::numbers::pi) * x * std::erf(x) - 1.0 + std::exp(-x * x)) / (x * x);
    const Sample sample({.length = 2.0, .covariance = Covariance::gaussian, .seed = 3}, 600, 1.0,
                        2.0 * x);
    CAPTURE(x);
    CHECK(std::sqrt(sample.moment(2)) == Approx(mean).epsilon(0.05));
}
