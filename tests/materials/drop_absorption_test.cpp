#include "materials/atmosphere/drop_absorption.hpp"

#include <catch2/catch.hpp>
#include <complex>

#include "materials/atmosphere/mie.hpp"

using namespace diurna;

// Against Mie's series for drops about 10 µm (Hansen and Travis' narrow gamma distribution is taken
// by radii from 7 to 13 µm), water's indices by Hale and Querry 1973, table 1.
TEST_CASE("cloud drops absorb as Mie's series says", "[materials][cloud]") {
    struct Row {
        double um;
        std::complex<double> index;
        double close;  // of 1 − ω
    };
    const Row row = GENERATE(Row{1.6, {1.317, 8.55e-5}, 0.2}, Row{2.2, {1.296, 2.89e-4}, 0.2},
                             Row{3.8, {1.364, 3.40e-3}, 0.2}, Row{3.0, {1.371, 0.272}, 0.15});
    double extinction = 0.0, scattering = 0.0;
    for (double radius = 7.0; radius <= 13.0; radius += 0.05) {
        const MieEfficiency of = mie(row.index, 2.0 * 3.14159265358979 * radius / row.um);
        extinction += radius * radius * of.extinction;
        scattering += radius * radius * of.scattering;
    }
    const double absorbed = 1.0 - scattering / extinction;
    CAPTURE(row.um, absorbed);
    CHECK(1.0 - drop_single_albedo(row.um) == Approx(absorbed).epsilon(row.close));
}

TEST_CASE("cloud drops absorb next to nothing of visible light", "[materials][cloud]") {
    CHECK(1.0 - drop_single_albedo(0.55) < 1e-5);
}
