#include "render/eye/apparent_temperature.hpp"

#include <catch2/catch.hpp>

#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/bins.hpp"
#include "materials/radiation/planck.hpp"

using namespace diurna;

TEST_CASE("the table of apparent temperature is the exact inverse to 0.05 mK",
          "[render][apparent][by_comparison]") {
    const Band band = GENERATE(flat_band("3-5", 3.0, 5.0, bin_edges_um()),
                               flat_band("8-12", 8.0, 12.0, bin_edges_um()));
    const double low = band_radiance(band, 150.0), high = band_radiance(band, 900.0);
    const TemperatureScale scale(band, low, high);
    double worst = 0.0;
    for (double t = 150.0; t <= 900.0; t += 0.77) {
        worst = std::max(worst, std::abs(scale(band_radiance(band, t)) - t));
    }
    CAPTURE(band.name, worst);
    CHECK(worst < 5e-5);
    CHECK(scale(0.0) == 0.0);
    CHECK(scale(-1.0) == 0.0);
    // Outside the table: inverted directly.
    CHECK(scale(band_radiance(band, 1500.0)) == Approx(1500.0).epsilon(1e-9));
    CHECK(TemperatureScale(band, 0.0, 0.0)(low) == Approx(150.0).epsilon(1e-9));
    CHECK(TemperatureScale(band, low, low)(low) == Approx(150.0).epsilon(1e-9));
}
