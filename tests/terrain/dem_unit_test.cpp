#include <catch2/catch.hpp>
#include <fstream>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "terrain/raster/geotiff.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;

namespace {

constexpr const char* feet_map = "EPSG:2274";  // NAD83, Tennessee, US survey feet

/// A level raster of 1000 units with heights of a unit.
std::filesystem::path level_raster(const ScratchFolder& folder, const std::string& unit,
                                   const std::string& crs, float height = 1000.0f) {
    Dem dem;
    dem.columns = dem.rows = 4;
    dem.height.assign(16, height);
    dem.transform = {1.7e6, 100.0, 0.0, 6.0e5, 0.0, -100.0};
    dem.crs_wkt = crs;
    const auto file = folder.path / "level.tif";
    write_geotiff(file, dem, {{"height", dem.height, unit}});
    return file;
}

}  // namespace

TEST_CASE("heights in feet become metres, and that is noted", "[terrain][dem][units]") {
    const ScratchFolder folder("dem_unit");
    const Dem dem = read_dem(level_raster(folder, "US_survey_feet", feet_map));
    CHECK(dem.at(0, 0) == Approx(1000.0 * 1200.0 / 3937.0).epsilon(1e-6));
    REQUIRE(dem.notes.size() >= 1);
    CHECK_THAT(dem.notes.front(), Catch::Contains("US survey foot"));
    CHECK(dem.warnings.empty());
}

TEST_CASE("heights without a unit on a map in feet are warned of", "[terrain][dem][units]") {
    const ScratchFolder folder("dem_unit_none");
    const auto file = level_raster(folder, "", feet_map);
    const Dem dem = read_dem(file);
    CHECK(dem.at(0, 0) == 1000.0f);
    REQUIRE(dem.warnings.size() == 1);
    CHECK_THAT(dem.warnings.front().line(),
               Catch::Contains("foot") && Catch::Contains("height_unit"));
    CHECK(read_dem(file, {.unit = 0.3048}).warnings.empty());
    CHECK(read_dem(file, {.unit = 0.3048}).at(0, 0) == Approx(304.8));
}

TEST_CASE("geopotential is divided by standard gravity", "[terrain][dem][units]") {
    const ScratchFolder folder("dem_unit_z");
    const Dem dem = read_dem(level_raster(folder, "m**2 s**-2", "EPSG:32616", 3138.128f));
    CHECK(dem.at(0, 0) == Approx(320.0).epsilon(1e-6));  // 320 m · 9.80665 m s⁻²
}

TEST_CASE("a unit that is no length is refused", "[terrain][dem][units]") {
    const ScratchFolder folder("dem_unit_bad");
    const auto file = level_raster(folder, "furlong", "EPSG:32616");
    CHECK_THROWS_WITH(read_dem(file),
                      Catch::Contains("'furlong'") && Catch::Contains("height_unit"));
    CHECK(read_dem(file, {.unit = 1.0}).at(0, 0) == 1000.0f);
}

TEST_CASE("EHdr heights read without their sign name the header's key", "[terrain][dem][units]") {
    // Esri's "BIL, BIP, and BSQ raster files": PIXELTYPE is SIGNEDINT or else unsigned; -12 as two
    // bytes, low first, is F4 FF.
    const ScratchFolder folder("dem_ehdr");
    const auto file = folder.path / "shore.bil";
    const std::string header =
        "NROWS 2\nNCOLS 2\nNBANDS 1\nNBITS 16\nBYTEORDER I\nLAYOUT BIL\nULXMAP 500000\n"
        "ULYMAP 5000000\nXDIM 30\nYDIM 30\n";
    std::ofstream(folder.path / "shore.hdr") << header;
    std::ofstream(folder.path / "shore.prj")
        << "PROJCS[\"UTM 32\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,"
           "298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
           "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"
           "PARAMETER[\"central_meridian\",9],PARAMETER[\"scale_factor\",0.9996],"
           "PARAMETER[\"false_easting\",500000],PARAMETER[\"false_northing\",0],"
           "UNIT[\"metre\",1]]";
    std::ofstream(file, std::ios::binary) << std::string("\x05\x00\xF4\xFF\x07\x00\x08\x00", 8);
    CHECK_THROWS_WITH(read_dem(file), Catch::Contains("65524") && Catch::Contains("-12") &&
                                          Catch::Contains("PIXELTYPE SIGNEDINT into shore.hdr"));
    std::ofstream(folder.path / "shore.hdr") << header << "PIXELTYPE SIGNEDINT\n";
    CHECK(read_dem(file).at(0, 1) == -12.0f);
}
