#include "render/band_table.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "materials/band_model.hpp"
#include "materials/planck.hpp"
#include "tests/render_scene.hpp"

using namespace diurna;

namespace {

Band band_of(const std::string& name) {
    if (name == "3-5") return flat_band("3-5", 3.0, 5.0, bin_edges_um());
    if (name == "0.4-0.7") return flat_band("0.4-0.7", 0.4, 0.7, bin_edges_um());
    if (name == "8-30") return flat_band("8-30", 8.0, 30.0, bin_edges_um());
    return flat_band("8-12", 8.0, 12.0, bin_edges_um());
}

double sum(const std::vector<float>& v) { return std::accumulate(v.begin(), v.end(), 0.0); }

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

// Against Planck's law summed over the nodes; tolerance 0.1 mK of temperature.
TEST_CASE("tables of emission agree with Planck's law to 0.1 mK", "[render][band_table]") {
    const Band band = band_of(GENERATE("3-5", "8-12", "8-30"));
    const MaterialLibrary materials = testing::materials(290.0);
    const Channels channels = channels_of(band);
    const SurfaceTable table(band, channels, materials, {true, true, true, true},
                             temperature_grid(200.0, 1000.0));
    std::vector<float> black(channels.padded()), emitted(black), reflectance(black);
    for (double t = 200.0; t <= 1000.0; t += 7.3) {
        const auto temperature = static_cast<float>(t);
        table.black(temperature, black.data());
        const double slope = band_radiance_derivative(band, t);
        CAPTURE(band.name, t);
        CHECK(std::abs(sum(black) - band_radiance(band, temperature)) / slope < 1e-4);
        table.surface(MaterialId{testing::soil}, temperature, emitted.data(), reflectance.data());
        const Material& soil = materials[MaterialId{testing::soil}];
        double exact = 0.0, closed = 0.0;
        for (std::size_t n = 0; n < band.node_um.size(); ++n) {
            exact += band.weight[n] * soil.emissivity(band.node_um[n]) *
                     planck(band.node_um[n], temperature);
        }
        for (std::size_t c = 0; c < black.size(); ++c) {
            closed += double{emitted[c]} + double{reflectance[c]} * double{black[c]};
        }
        CHECK(std::abs(sum(emitted) - exact) / slope < 1e-4);
        // Kirchhoff: what is not emitted is reflected.
        CHECK(closed == Approx(sum(black)).epsilon(1e-6));
    }
}

TEST_CASE("reflectances are finite where nothing of that temperature shines",
          "[render][band_table][stress]") {
    const Band band = band_of("0.4-0.7");
    const Channels channels = channels_of(band);
    const SurfaceTable table(band, channels, testing::materials(290.0), {true, true, true, true},
                             temperature_grid(30.0, 320.0));
    std::vector<float> emitted(channels.padded()), reflectance(channels.padded());
    for (const float temperature : {30.0f, 31.0f, 150.0f, 320.0f}) {
        table.surface(MaterialId{testing::metal}, temperature, emitted.data(), reflectance.data());
        for (std::size_t c = 0; c < channels.size(); ++c) {
            CHECK(emitted[c] >= 0.0f);
            CHECK(reflectance[c] == Approx(0.9).epsilon(1e-6));
        }
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
