#include "materials/atmosphere/two_stream.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace diurna;

namespace {

std::vector<ScatteringLayer> slab(double depth, double w, double g, double mu, int cuts) {
    std::vector<ScatteringLayer> layers;
    for (int i = 0; i < cuts; ++i) {
        layers.push_back({depth / cuts, w, g, std::exp(-depth * i / cuts / mu),
                          std::exp(-depth * (i + 1) / cuts / mu)});
    }
    return layers;
}

}  // namespace

TEST_CASE("light that nothing absorbs is all accounted for",
          "[materials][two_stream][by_degenerate]") {
    for (const double depth : {0.01, 0.3, 3.0, 30.0}) {
        for (const double mu : {0.1, 0.5, 1.0}) {
            const auto flux = two_stream(slab(depth, 1.0, 0.4, mu, 5), mu, 0.0);
            CAPTURE(depth, mu);
            CHECK(flux.up[0] + flux.down[5] + mu * std::exp(-depth / mu) ==
                  Approx(mu).epsilon(1e-5));
            // Over white ground everything comes back.
            CHECK(two_stream(slab(depth, 1.0, 0.4, mu, 5), mu, 1.0).up[0] ==
                  Approx(mu).epsilon(1e-4));
        }
    }
}

TEST_CASE("cutting a slab changes nothing", "[materials][two_stream][by_degenerate]") {
    const auto one = two_stream(slab(2.0, 0.9, 0.5, 0.6, 1), 0.6, 0.3);
    const auto many = two_stream(slab(2.0, 0.9, 0.5, 0.6, 20), 0.6, 0.3);
    CHECK(many.up[0] == Approx(one.up[0]).epsilon(1e-10));
    CHECK(many.down[20] == Approx(one.down[1]).epsilon(1e-10));
}

TEST_CASE("thick clouds reflect as the two-stream closed form says",
          "[materials][two_stream][by_comparison]") {
    // Conservative, diffuse light from above: R = a / (1 + a), a = (3/4)(1 - g) tau (Eddington).
    const double tau = 20.0, g = 0.85, a = 0.75 * (1.0 - g) * tau;
    std::vector<ScatteringLayer> cloud = {{tau, 1.0, g, 0.0, 0.0}};
    const auto flux = two_stream(cloud, 0.5, 0.0, 1.0);
    CHECK(flux.up[0] == Approx(a / (1.0 + a)).epsilon(1e-4));
    CHECK(flux.down[1] == Approx(1.0 / (1.0 + a)).epsilon(1e-4));
}

TEST_CASE("thin layers scatter half up, half down, in proportion to depth",
          "[materials][two_stream]") {
    const double tau = 1e-4, mu = 0.7;
    const auto flux = two_stream(slab(tau, 1.0, 0.0, mu, 1), mu, 0.0);
    CHECK(flux.up[0] == Approx(0.5 * tau).epsilon(1e-3));
    CHECK(flux.down[1] == Approx(0.5 * tau).epsilon(1e-3));
}

TEST_CASE("a scattering slab reflects what photons do, to 3 % of the sun",
          "[materials][two_stream][by_comparison]") {
    // 200 000 photons through a conservative, isotropic slab of depth 0.25 or 2 over black ground,
    // sun at 60 degrees: one standard error is 0.001.
    const double mu = 0.5;
    for (const double depth : {0.25, 2.0}) {
        std::mt19937_64 random(7);
        std::uniform_real_distribution<double> unit(1e-300, 1.0);
        int reflected = 0;
        constexpr int photons = 200000;
        for (int i = 0; i < photons; ++i) {
            double place = 0.0, cosine = mu;  // depth, and cosine of the way down
            while (true) {
                place -= cosine * std::log(unit(random));
                if (place < 0.0) ++reflected;
                if (place < 0.0 || place > depth) break;
                cosine = 2.0 * unit(random) - 1.0;
            }
        }
        const auto flux = two_stream(slab(depth, 1.0, 0.0, mu, 4), mu, 0.0);
        CAPTURE(depth);
        CHECK(flux.up[0] / mu == Approx(double(reflected) / photons).margin(0.03));
    }
}

TEST_CASE("rates that meet do not divide by zero", "[materials][two_stream][stress][by_extreme]") {
    for (double mu = 0.05; mu <= 1.0; mu += 0.001) {
        for (const double w : {0.0, 0.5, 0.9, 0.999999, 1.0}) {
            const auto flux = two_stream(slab(1.0, w, 0.3, mu, 3), mu, 0.2);
            if (!(flux.up[0] >= 0.0 && flux.up[0] <= mu && flux.down[3] >= -1e-12)) {
                FAIL("mu " << mu << " w " << w << " up " << flux.up[0]);
            }
        }
    }
}
