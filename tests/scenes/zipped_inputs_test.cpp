#include <catch2/catch.hpp>
#include <string>

#include "materials/base/error.hpp"
#include "scenes/products/export/inspect.hpp"
#include "scenes/products/export/zip_file.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

TEST_CASE("a raster in a zip archive is read by any name of the archive", "[terrain][dem][zip]") {
    const ScratchFolder folder("dem_zip");
    // SRTM: 1201 x 1201 heights of 16 bits, the higher byte first.
    std::string heights;
    for (int i = 0; i < 1201 * 1201; ++i) heights += std::string("\x01\x90", 2);  // 400 m
    const auto archive = folder.path / "N38E049.SRTMGL3.hgt.zip";
    write_text(archive, zip_archive({{"readme.txt", "SRTM"}, {"N38E049.hgt", heights}}));
    CHECK(inspect(archive).kind == "elevation raster");
    const Dem dem = read_dem(archive);
    CHECK(dem.columns == 1201);
    CHECK(dem.at(600, 600) == 400.0f);

    write_text(folder.path / "two.zip", zip_archive({{"a.tif", "x"}, {"b.tif", "y"}}));
    CHECK_THROWS_WITH(read_dem(folder.path / "two.zip"), Catch::Contains("2 rasters"));
    write_text(folder.path / "none.zip", zip_archive({{"notes.md", "x"}}));
    CHECK_THROWS_WITH(read_dem(folder.path / "none.zip"), Catch::Contains("notes.md"));
}
