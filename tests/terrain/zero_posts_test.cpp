#include "terrain/raster/zero_posts.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>

using namespace diurna;

namespace {

constexpr int posts = 61;

/// Posts of 30 m with heights by a formula of the distances [m] from the middle, east and north.
template <class Height>
Dem raster(const Height& height) {
    Dem dem;
    dem.source = "place.tif";
    dem.columns = dem.rows = posts;
    for (int row = 0; row < posts; ++row) {
        for (int column = 0; column < posts; ++column) {
            dem.height.push_back(
                float(height(30.0 * (column - posts / 2), 30.0 * (posts / 2 - row))));
        }
    }
    return dem;
}

double hill(double x, double y) { return 500.0 + 300.0 * std::exp(-(x * x + y * y) / 720e3); }

std::string warning_of(Dem dem) {
    warn_of_zero_posts(dem);
    REQUIRE(dem.warnings.size() <= 1);
    return dem.warnings.empty() ? "" : dem.warnings.front().line();
}

}  // namespace

TEST_CASE("zeros within high ground raise a warning with their number", "[terrain][dem][zeros]") {
    Dem pit = raster(hill);
    for (int row = 40; row < 43; ++row) {
        for (int column = 40; column < 43; ++column)
            pit.height[std::size_t(row * posts + column)] = 0;
    }
    const std::string line = warning_of(pit);
    CHECK(line.find("place.tif: 9 posts (0.24 %) of exactly 0 m") == 0);
    CHECK(line.find("gdal_translate -a_nodata 0") != std::string::npos);
    CHECK(warning_of(raster(hill)).empty());
}

TEST_CASE("the wedges of a turned raster raise a warning", "[terrain][dem][zeros]") {
    const auto wedge = [](double x, double y) {
        return y > 700.0 + 0.1 * x || y < -700.0 + 0.1 * x;
    };
    CHECK_FALSE(warning_of(raster([&](double x, double y) {
                    return wedge(x, y) ? 0.0 : hill(x, y);
                })).empty());
    // A row mixed of zeros and heights between them, as bilinear resampling leaves it.
    CHECK_FALSE(warning_of(raster([&](double x, double y) {
                    if (wedge(x, y)) return 0.0;
                    const double share = (700.0 + 0.1 * x - y) / 30.0;
                    return std::min(1.0, std::max(0.01, share)) * hill(x, y);
                })).empty());
}

TEST_CASE("a sea of zeros raises no warning", "[terrain][dem][zeros]") {
    // A shore that rises by 1 in 5; one with a cliff of 200 m along half of it; a fjord with walls
    // of 45 degrees; a sea without land.
    CHECK(warning_of(raster([](double x, double) { return std::max(0.0, 0.2 * x); })).empty());
    CHECK(warning_of(raster([](double x, double y) {
              return x <= 0.0 ? 0.0 : y > 0.0 ? 200.0 + 0.1 * x : 0.05 * x;
          })).empty());
    CHECK(warning_of(raster([](double x, double) {
              return std::clamp(std::abs(x) - 150.0, 0.0, 900.0);
          })).empty());
    CHECK(warning_of(raster([](double, double) { return 0.0; })).empty());
}

TEST_CASE("a field at sea level beside a polder raises no warning", "[terrain][dem][zeros]") {
    CHECK(warning_of(raster([](double x, double) { return x < 0.0 ? 0.0 : -4.0; })).empty());
}
