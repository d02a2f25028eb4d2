#include "terrain/raster/dem_notes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

using namespace diurna;

namespace {

/// The notes on the datum of a raster of 2 x 2 posts there.
std::vector<std::string> datum_notes(const std::string& crs, double x, double y) {
    Dem dem;
    dem.source = "place.tif";
    dem.columns = dem.rows = 2;
    dem.height.assign(4, 0.0f);
    const double cell = std::abs(x) <= 180.0 ? 1e-4 : 10.0;
    dem.transform = {x, cell, 0.0, y, 0.0, -cell};
    dem.crs_wkt = crs;
    note_datum(dem);
    return dem.notes;
}

}  // namespace

// EPSG's accuracies of the transformations to WGS 84: 1 m (1149 ETRS89, 1671 RGF93, 1565 NZGD2000,
// 15894 SIRGAS 2000, 1901 REGVEN), 3 m (1150 GDA94), 4 m (1188 NAD83), 2 m (JGD2011).
TEST_CASE("datums of ITRS agree with WGS84 and have no note", "[terrain][dem][datum]") {
    const auto [crs, x, y] = GENERATE(table<const char*, double, double>(
        {{"EPSG:25832", 500000.0, 5000000.0},       // ETRS89 / UTM 32N
         {"EPSG:3035", 4321000.0, 3210000.0},       // ETRS89 / LAEA Europe
         {"EPSG:4258", 9.0, 45.0},                  // ETRS89
         {"EPSG:2154", 700000.0, 6544000.0},        // RGF93 / Lambert-93
         {"EPSG:28355", 500000.0, 5900000.0},       // GDA94 / MGA 55
         {"EPSG:7855", 500000.0, 5900000.0},        // GDA2020 / MGA 55
         {"EPSG:2193", 1700000.0, 5500000.0},       // NZGD2000
         {"EPSG:4269", -105.0, 40.0},               // NAD83
         {"EPSG:6318", -105.0, 40.0},               // NAD83(2011)
         {"EPSG:4617", -80.0, 55.0},                // NAD83(CSRS)
         {"EPSG:31983", 500000.0, 7500000.0},       // SIRGAS 2000 / UTM 23S
         {"EPSG:4490", 110.0, 35.0},                // CGCS2000
         {"EPSG:6668", 139.0, 36.0},                // JGD2011
         {"EPSG:4737", 127.0, 36.0},                // Korea 2000
         {"EPSG:9000", 9.0, 45.0},                  // ITRF2014
         {"EPSG:25832+5773", 500000.0, 5000000.0},  // with heights above EGM96
         {"EPSG:4326", 9.0, 45.0},
         {"EPSG:32632", 500000.0, 5000000.0}}));
    CAPTURE(crs);
    CHECK(datum_notes(crs, x, y) == std::vector<std::string>{});
}

TEST_CASE("a datum without a known shift to WGS84 is reported", "[terrain][dem][datum]") {
    // Xian 1980: the parameters of China's older datum are not public.
    const auto notes = datum_notes("EPSG:4610", 110.0, 35.0);
    REQUIRE(notes.size() == 1);
    CHECK(notes.front().find("place.tif: the shift from Xian_1980 to WGS84 is unknown") == 0);
}

TEST_CASE("a datum far from WGS84 is reported with its shift", "[terrain][dem][datum]") {
    // ED50 in northern Italy: -87, -98, -121 m (EPSG 1133), 130 m along the ground.
    const auto notes = datum_notes("EPSG:4230", 9.0, 45.0);
    REQUIRE(notes.size() == 1);
    CHECK(notes.front().find("European_Datum_1950 is converted to WGS84 by a shift of 13") !=
          std::string::npos);
}
