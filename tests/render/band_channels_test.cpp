#include "render/light/band_channels.hpp"

#include <catch2/catch.hpp>

#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/bins.hpp"

using namespace diurna;

namespace {

Band band_of(const std::string& name) {
    if (name == "3-5") return flat_band("3-5", 3.0, 5.0, bin_edges_um());
    if (name == "0.4-0.7") return flat_band("0.4-0.7", 0.4, 0.7, bin_edges_um());
    if (name == "8-30") return flat_band("8-30", 8.0, 30.0, bin_edges_um());
    return flat_band("8-12", 8.0, 12.0, bin_edges_um());
}

}  // namespace

TEST_CASE("channels hold every node once and no bin edge inside", "[render][channels]") {
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
