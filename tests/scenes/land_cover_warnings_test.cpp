#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"
#include "terrain/raster/geotiff.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// Warnings on land cover of 8 km about the site or `east` of it, in cells of 50 m: 10 in its west,
/// 50 in its east, and `mixed` cells that are interpolated between them.
std::vector<std::string> cover_warnings(const std::string& table, double east_m = 0.0,
                                        int mixed = 0) {
    const ScratchFolder folder("cover_warnings");
    constexpr int cells = 200;
    Dem place;
    place.source = "classes";
    place.columns = place.rows = cells;
    // Web Mercator; 1 m on the ground is 1.24 m there.
    const double x = -84.203333 * M_PI / 180.0 * 6378137.0 + 1.24 * east_m;
    const double y = 6378137.0 * std::asinh(std::tan(36.32 * M_PI / 180.0));
    place.transform = {x - 6200.0, 62.0, 0.0, y + 6200.0, 0.0, -62.0};
    place.crs_wkt = "EPSG:3857";
    std::vector<float> classes;
    for (int row = 0; row < cells; ++row) {
        for (int column = 0; column < cells; ++column) {
            const double share = mixed == 0 ? (column < cells / 2 ? 0.0 : 1.0)
                                            : (column - cells / 2 + 0.5 * mixed) / mixed;
            classes.push_back(
                static_cast<float>(std::round(10.0 + 40.0 * std::clamp(share, 0.0, 1.0))));
        }
    }
    write_geotiff(folder.path / "classes.tif", place, {{"class", classes}});
    const auto file = folder.path / "scene.toml";
    write_text(file, small_scene() + "[terrain.land_cover]\nfile = \"classes.tif\"\n" +
                         "[terrain.land_cover.material]\n" + table);
    return as_lines(land_cover_warnings(prepare(read_scene(file))));
}

constexpr const char* both = "10 = \"sand\"\n50 = \"bare_soil\"\n";

}  // namespace

TEST_CASE("land cover of all the ground raises no warning", "[scenes][warnings][land_cover]") {
    CHECK(cover_warnings(both) == std::vector<std::string>{});
}

TEST_CASE("land cover far from the ground raises a warning", "[scenes][warnings][land_cover]") {
    const auto lines = cover_warnings(both, 90e3);
    REQUIRE(lines.size() == 1);
    CHECK_THAT(lines.front(), Catch::Contains("classes.tif: covers 0 % of the ground") &&
                                  Catch::Contains("10, 50") && Catch::Contains("CRS"));
}

TEST_CASE("land cover of a part of the ground raises a warning with its share",
          "[scenes][warnings][land_cover]") {
    // Its west edge is on the site's meridian, 4 km of 8: half of the ground.
    const auto lines = cover_warnings(both, 4990.0);
    REQUIRE(lines.size() == 1);
    CHECK_THAT(lines.front(), Catch::Contains("covers 4") || Catch::Contains("covers 5"));
}

TEST_CASE("classes without a material and keys without ground raise a warning",
          "[scenes][warnings][land_cover]") {
    const auto lines = cover_warnings("1 = \"sand\"\n2 = \"bare_soil\"\n");
    REQUIRE(lines.size() == 1);
    CHECK_THAT(lines.front(), Catch::Contains("covers 100 % of the ground") &&
                                  Catch::Contains("classes without a material: ") &&
                                  Catch::Contains("10 (") && Catch::Contains("50 (") &&
                                  Catch::Contains("not on the ground: 1, 2"));
    const auto half = cover_warnings("10 = \"sand\"\n");
    REQUIRE(half.size() == 1);
    CHECK_THAT(half.front(), Catch::Contains("classes without a material: 50 ("));
}

TEST_CASE("interpolated class numbers raise a warning", "[scenes][warnings][land_cover]") {
    const auto lines = cover_warnings(both, 0.0, 10);
    REQUIRE_FALSE(lines.empty());
    CHECK_THAT(lines.front(),
               Catch::Contains("were interpolated") && Catch::Contains("gdalwarp -r near"));
}
