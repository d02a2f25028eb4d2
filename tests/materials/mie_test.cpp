#include "materials/atmosphere/mie.hpp"

#include <catch2/catch.hpp>

using namespace diurna;

TEST_CASE("a sphere scatters as Bohren and Huffman's program prints",
          "[materials][mie][by_comparison]") {
    // Appendix A: n = 1.55, x = 5.21283 gives Q = 3.10543 (sphere of 0.525 um at 0.6328 um).
    const MieEfficiency q = mie({1.55, 0.0}, 5.21283);
    CHECK(q.extinction == Approx(3.10543).epsilon(2e-5));
    CHECK(q.scattering == Approx(3.10543).epsilon(2e-5));
    CHECK(q.asymmetry == Approx(0.63314).epsilon(1e-4));
}

TEST_CASE("small spheres scatter as Rayleigh says, large ones as twice their shadow",
          "[materials][mie][by_comparison]") {
    const double x = 0.01;
    const MieEfficiency small = mie({1.5, 0.0}, x);
    const double lorentz = (1.5 * 1.5 - 1.0) / (1.5 * 1.5 + 2.0);
    CHECK(small.scattering == Approx(8.0 / 3.0 * x * x * x * x * lorentz * lorentz).epsilon(1e-3));
    CHECK(std::abs(small.asymmetry) < 1e-3);
    CHECK(mie({1.33, 0.1}, 3000.0).extinction == Approx(2.0).epsilon(0.02));
}

TEST_CASE("a sphere without absorption loses no light", "[materials][mie][by_degenerate]") {
    for (const double x : {0.3, 3.0, 30.0, 300.0}) {
        const MieEfficiency q = mie({1.4, 0.0}, x);
        CHECK(q.scattering == Approx(q.extinction).epsilon(1e-9));
        CHECK(mie({1.4, 0.01}, x).scattering < mie({1.4, 0.01}, x).extinction);
    }
}

TEST_CASE("a phase function has mean one and the asymmetry of its series", "[materials][mie]") {
    const std::vector<SizeMode> modes = {{1.0, 0.2, 0.2}, {0.1, 1.0, 0.0, 6.0, 1.0}};
    const std::vector<std::complex<double>> index = {{1.5, 0.01}, {1.33, 0.0}};
    std::vector<double> cosine;
    constexpr int steps = 20000;
    for (int i = 0; i < steps; ++i) cosine.push_back(-1.0 + 2.0 * (i + 0.5) / steps);
    const std::vector<double> phase = mie_phase(modes, index, 0.55, cosine);
    double mean = 0.0, asymmetry = 0.0;
    for (int i = 0; i < steps; ++i) {
        mean += phase[std::size_t(i)] / steps;
        asymmetry += phase[std::size_t(i)] * cosine[std::size_t(i)] / steps;
    }
    CHECK(mean == Approx(1.0).epsilon(1e-3));
    CHECK(asymmetry == Approx(mie_mean(modes, index, 0.55).asymmetry).epsilon(1e-3));
}
