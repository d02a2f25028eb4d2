#include "render/light/band_channels.hpp"

#include <catch2/catch.hpp>

#include "materials/atmosphere/band_model.hpp"
#include "materials/radiation/planck.hpp"
#include "tests/support/render_scene.hpp"

using namespace diurna;

namespace {

Band band_of(const std::string& name) {
    if (name == "3-5") return flat_band("3-5", 3.0, 5.0, bin_edges_um());
    if (name == "0.4-0.7") return flat_band("0.4-0.7", 0.4, 0.7, bin_edges_um());
    if (name == "8-30") return flat_band("8-30", 8.0, 30.0, bin_edges_um());
    return flat_band("8-12", 8.0, 12.0, bin_edges_um());
}

}  // namespace

TEST_CASE("channels hold every node once and no bin edge inside", "[render][band_table]") {
    const Band band = band_of(GENERATE("3-5", "8-12", "8-30", "0.4-0.7"));
    const Channels channels = channels_of(band);
    CHECK(channels.first.front() == 0);
    CHECK(channels.first.back() == band.node_um.size());
    CHECK(channels.padded() % 8 == 0);
    for (std::size_t c = 0; c < channels.size(); ++c) {
        REQUIRE(channels.first[c] < channels.first[c + 1]);
        CHECK(bin_of(band.node_um[channels.first[c]]) ==
              bin_of(band.node_um[channels.first[c + 1] - 1]));
        CHECK(band.node_um[channels.first[c + 1] - 1] <= 1.05 * band.node_um[channels.first[c]]);
    }
}

TEST_CASE("the table of apparent temperature is the exact inverse to 0.05 mK",
          "[render][band_table]") {
    const Band band = band_of(GENERATE("3-5", "8-12"));
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
