#include "materials/radiation/planck.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/base/fast_exp.hpp"
#include "materials/base/units.hpp"

using namespace diurna;

namespace {

/// Planck's law in 64-bit-mantissa arithmetic, written from the constants h, c and k.
double planck_in_long_double(double wavelength_um, double temperature) {
    const long double h = 6.62607015e-34L, c = 299792458.0L, k = 1.380649e-23L;
    const long double m = static_cast<long double>(wavelength_um) * 1e-6L;
    const long double x = h * c / (k * m * temperature);
    return static_cast<double>(2.0L * h * c * c / (m * m * m * m * m) / expm1l(x) * 1e-6L);
}

}  // namespace

TEST_CASE("Planck's law agrees with 40-digit values", "[materials][planck][by_comparison]") {
    // mpmath, 40 digits, printed with 12: they can be met to 5e-12.
    struct Value {
        double temperature, wavelength_um, radiance, derivative;
    };
    const auto v = GENERATE(Value{200, 0.55, 3.70944261654e-48, 2.42593648414e-48},
                            Value{200, 10, 0.895343093043, 0.032229182947},
                            Value{250, 4, 0.065629505724, 0.00377705074391},
                            Value{288, 12.5, 7.30685831096, 0.103296320544},
                            Value{300, 0.55, 3.1933297418e-29, 9.28179594898e-30},
                            Value{300, 4, 0.721976422571, 0.0288547064085},
                            Value{300, 10, 9.92403333007, 0.159971567251},
                            Value{350, 10, 19.8523870206, 0.237055086265},
                            Value{1000, 4, 3277.66351896, 12.1217930509},
                            Value{1000, 12.5, 180.566869149, 0.303993637034},
                            Value{5900, 0.55, 28425808.6922, 21618.4738801},
                            Value{5900, 12.5, 1811.7344574, 0.338000192273});
    CAPTURE(v.temperature, v.wavelength_um);
    CHECK(planck(v.wavelength_um, v.temperature) == Approx(v.radiance).epsilon(5e-12));
    CHECK(planck_derivative(v.wavelength_um, v.temperature) == Approx(v.derivative).epsilon(5e-11));
}

TEST_CASE("Planck's law is right to 1e-12 from 0.35 to 20 um and 180 to 6000 K",
          "[materials][planck][by_comparison]") {
    double worst = 0.0;
    for (double um = 0.35; um <= 20.0; um *= 1.01) {
        for (double kelvins = 180.0; kelvins <= 6000.0; kelvins *= 1.03) {
            const double exact = planck_in_long_double(um, kelvins);
            worst = std::max(worst, std::abs(planck(um, kelvins) / exact - 1.0));
        }
    }
    CHECK(worst < 1e-12);
}

TEST_CASE("the derivative of Planck's law is its slope", "[materials][planck][by_variation]") {
    const double um = GENERATE(0.6, 4.0, 10.0, 30.0);
    const double kelvins = GENERATE(230.0, 300.0, 900.0);
    const double step = 1e-3 * kelvins * std::min(1.0, um * kelvins / 14387.77);
    const auto difference = [&](double d) {
        return (planck(um, kelvins + d) - planck(um, kelvins - d)) / (2.0 * d);
    };
    // Richardson: the error of the central difference falls with the square of its step.
    const double slope = (4.0 * difference(0.5 * step) - difference(step)) / 3.0;
    CHECK(planck_derivative(um, kelvins) == Approx(slope).epsilon(1e-9));
}

TEST_CASE("Planck's law integrates to Stefan-Boltzmann", "[materials][planck][by_comparison]") {
    const double temperature = GENERATE(220.0, 300.0, 340.0, 800.0);
    CAPTURE(temperature);
    // 0.2 to 100 um; beyond 100 um Rayleigh-Jeans with its next two terms:
    // B = c1 l^-4 T / c2 (1 - x/2 + x^2/12 - ...), x = c2 / (l T).
    const double x = second_radiation_um / (100.0 * temperature);
    const double tail = first_radiation_um * temperature / second_radiation_um / 1e6 *
                        (1.0 / 3.0 - x / 8.0 + x * x / 60.0 - std::pow(x, 4) / 720.0 / 7.0);
    const double total = band_radiance(flat_band("", 0.2, 100.0), temperature) + tail;
    CHECK(std::numbers::pi * total ==
          Approx(stefan_boltzmann * std::pow(temperature, 4)).epsilon(1e-7));
}

TEST_CASE("band radiances agree with 40-digit integrals to 1e-7",
          "[materials][planck][band][by_comparison]") {
    struct Value {
        double from, to, temperature, radiance, derivative;
    };
    const auto v = GENERATE(Value{3, 5, 250, 0.21703496651, 0.0110885759857},
                            Value{3, 5, 300, 1.86595620816, 0.0676983441532},
                            Value{3, 5, 350, 8.97434993125, 0.244249749803},
                            Value{3, 5, 1000, 6506.73397876, 25.1380943115},
                            Value{3, 5, 5900, 330973.657012, 77.0864227737},
                            Value{3.5, 4.1, 250, 0.025788365924, 0.00153446477839},
                            Value{3.5, 4.1, 300, 0.309487114111, 0.0128481160812},
                            Value{4.5, 5, 300, 1.02015953749, 0.0342068483186},
                            Value{8, 12, 250, 14.5593009754, 0.336948794803},
                            Value{8, 12, 300, 38.5004239333, 0.629704346722},
                            Value{8, 12, 350, 78.0355418407, 0.953323441739},
                            Value{8, 12, 1000, 1602.82986346, 3.12158301465},
                            Value{8, 14, 300, 54.9334613768, 0.837821289528},
                            Value{7.5, 13.5, 300, 55.4916113678, 0.882488632853},
                            Value{0.4, 0.7, 1000, 0.0331853467103, 0.000720318729226},
                            Value{0.4, 0.7, 5900, 8134326.02051, 6398.30007721},
                            Value{1.5, 1.8, 1000, 478.165123489, 4.13942352355},
                            Value{1.5, 1.8, 5900, 877217.07123, 286.557940315});
    CAPTURE(v.from, v.to, v.temperature);
    const Band band = flat_band("", v.from, v.to);
    CHECK(band_radiance(band, v.temperature) == Approx(v.radiance).epsilon(1e-7));
    CHECK(band_radiance_derivative(band, v.temperature) == Approx(v.derivative).epsilon(1e-7));
}

TEST_CASE("mixed pixels have the brightness temperature of their radiance", "[materials][planck]") {
    struct Value {
        double from, to, radiance, temperature;
    };
    const auto v = GENERATE(
        Value{3, 5, 1.78351014608, 298.759247712}, Value{3, 5, 3.33243930686, 316.820841473},
        Value{3, 5, 1.66228218033, 296.845560376}, Value{8, 12, 37.3033677855, 298.080576445},
        Value{8, 12, 48.0153788338, 314.105189752}, Value{8, 12, 36.3687120486, 296.555405577},
        Value{8, 14, 53.3014027924, 298.034442847}, Value{8, 14, 67.3077853283, 313.887695893},
        Value{8, 14, 52.0812690173, 296.541307767});
    CAPTURE(v.from, v.to);
    CHECK(brightness_temperature(flat_band("", v.from, v.to), v.radiance) ==
          Approx(v.temperature).margin(1e-6).epsilon(0));
}

TEST_CASE("brightness temperature undoes band radiance", "[materials][planck]") {
    const double kelvins = GENERATE(3.0, 30.0, 180.0, 300.0, 1500.0, 6000.0, 1e6);
    for (const Band& band : {flat_band("", 0.4, 0.7), flat_band("", 3, 5), flat_band("", 8, 14)}) {
        const double radiance = band_radiance(band, kelvins);
        if (radiance < 1e-290) continue;  // nothing to tell temperatures apart by
        CAPTURE(band.from_um(), kelvins);
        // The radiance is known to some 1e-14; hot bodies need relative terms.
        CHECK(brightness_temperature(band, radiance) ==
              Approx(kelvins).margin(1e-9).epsilon(2e-13));
    }
}

TEST_CASE("the temperature of a spectral radiance undoes Planck's law", "[materials][planck]") {
    for (const double um : {0.35, 1.0, 3.9, 10.0, 20.0}) {
        for (const double kelvins : {180.0, 300.0, 1500.0, 6000.0}) {
            CAPTURE(um, kelvins);
            CHECK(planck_temperature(um, planck(um, kelvins)) == Approx(kelvins).epsilon(1e-13));
        }
    }
}

TEST_CASE("extremes of temperature and wavelength survive",
          "[materials][planck][stress][by_extreme]") {
    CHECK(planck(0.35, 200) == Approx(1.23280141708e-79).epsilon(1e-11));
    CHECK(planck(0.4, 250) == Approx(3.80488570317e-53).epsilon(1e-11));
    CHECK(planck(10, 3) == Approx(6.18929573201e-206).epsilon(1e-11));
    CHECK(planck(20, 6000) == Approx(292.19286728).epsilon(1e-11));
    CHECK(planck(20, 1e5) == Approx(5155.26423344).epsilon(1e-11));
}

TEST_CASE("a black body far too cold to emit is dark, not NaN",
          "[materials][planck][stress][by_extreme]") {
    for (const double kelvins : {0.0, 1e-300, 1e-3, 1.0}) {
        CHECK(planck(0.35, kelvins) == 0.0);
        CHECK(planck_derivative(0.35, kelvins) == 0.0);
    }
    const Band band = flat_band("", 3, 5);
    CHECK(band_radiance(band, 0.0) == 0.0);
    CHECK(brightness_temperature(band, 0.0) == 0.0);
    CHECK(brightness_temperature(band, -1.0) == 0.0);
    CHECK(std::isfinite(brightness_temperature(band, 1e-300)));
}

TEST_CASE("the vector exponential is exact to 5e-16", "[materials][planck][by_comparison]") {
    double worst = 0.0;
    for (double x = -707.0; x < 708.0; x += 0.0371) {
        const long double exact = expl(static_cast<long double>(x));
        worst = std::max(worst, static_cast<double>(std::abs(fast_exp(x) / exact - 1.0L)));
    }
    CHECK(worst < 5e-16);
    CHECK(fast_exp(0.0) == 1.0);
    CHECK(fast_exp(-1e9) < 1e-300);
    CHECK(std::isfinite(fast_exp(1e9)));
    CHECK(std::isnan(fast_exp(std::nan(""))));
}

TEST_CASE("the single-precision exponential is good to 3e-7",
          "[materials][planck][by_comparison]") {
    double worst = 0.0;
    for (float x = -86.0f; x < 87.0f; x += 0.0037f) {
        const double exact = std::exp(double{x});
        worst = std::max(worst, std::abs(double{fast_exp(x)} / exact - 1.0));
    }
    CHECK(worst < 3e-7);
    CHECK(fast_exp(0.0f) == 1.0f);
    CHECK(fast_exp(-1e9f) < 1e-37f);
    CHECK(std::isfinite(fast_exp(1e9f)));
}
