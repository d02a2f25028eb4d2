#include <Eigen/Geometry>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "materials/base/error.hpp"
#include "terrain/ground/tin_check.hpp"
#include "terrain/ground/triangulate.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/geoid.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/post_places.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_data.hpp"

using namespace diurna;

namespace {

const PrivateTempFolder private_temp_folder;

/// An ESRI ASCII grid in the scratch folder, 0.1° cells.
std::filesystem::path grid(const std::string& name, int columns, int rows, double west,
                           double south, const std::string& values, double cell = 0.1) {
    const auto folder = std::filesystem::temp_directory_path();
    std::ofstream(folder / (name + ".asc"))
        << "ncols " << columns << "\nnrows " << rows << "\nxllcorner " << west << "\nyllcorner "
        << south << "\ncellsize " << cell << "\nNODATA_value -99\n"
        << values << "\n";
    std::ofstream(folder / (name + ".prj"))
        << "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
           "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]";
    return folder / (name + ".asc");
}

using Files = std::vector<std::filesystem::path>;

}  // namespace

TEST_CASE("tiles join at the posts they share", "[terrain][dem][mosaic]") {
    // Two of 3 × 3 that share a column.
    const Files tiles{grid("w", 3, 3, 8.0, 46.0, "1 2 3 4 5 6 7 8 9"),
                      grid("e", 3, 3, 8.2, 46.0, "3 20 30 6 50 60 9 80 90")};
    const Dem dem = read_dem(tiles);
    CHECK(dem.columns == 5);
    CHECK(dem.rows == 3);
    CHECK(dem.notes.empty());
    CHECK(dem.height == std::vector<float>{1, 2, 3, 20, 30, 4, 5, 6, 50, 60, 7, 8, 9, 80, 90});
    // The other way round the same, places too.
    const Dem turned = read_dem(Files{tiles[1], tiles[0]});
    CHECK(turned.height == dem.height);
    CHECK(turned.transform[0] == Approx(dem.transform[0]));
}

TEST_CASE("tiles that disagree are reported, unrelated ones refused", "[terrain][dem][mosaic]") {
    const auto first = grid("a", 3, 3, 8.0, 46.0, "1 2 3 4 5 6 7 8 9");
    const Dem dem = read_dem(Files{first, grid("b", 3, 3, 8.2, 46.0, "9 2 3 6 5 6 9 8 9")});
    REQUIRE(dem.notes.size() == 1);
    CHECK(dem.notes.front().find("1 post shared") != std::string::npos);
    CHECK(dem.notes.front().find("6.0 m") != std::string::npos);
    CHECK_THROWS_AS(read_dem(Files{first, grid("c", 3, 3, 8.25, 46.0, "1 2 3 4 5 6 7 8 9")}),
                    InputError);
    CHECK_THROWS_AS(read_dem(Files{first, grid("d", 3, 3, 8.2, 46.0, "1 2 3 4 5 6 7 8 9", 0.2)}),
                    InputError);
    CHECK_THROWS_AS(read_dem(Files{}), InputError);
}

TEST_CASE("tiles either side of the date line are neighbours", "[terrain][dem][mosaic][stress]") {
    const Dem dem = read_dem(Files{grid("e179", 3, 2, 179.7, -17.0, "1 2 3 4 5 6"),
                                   grid("w180", 3, 2, -180.0, -17.0, "7 8 9 10 11 12")});
    CHECK(dem.columns == 6);
    CHECK(dem.at(1, 3) == 10.0f);
    const auto places = post_places(dem);
    CHECK(std::remainder(places[3].longitude_deg - -179.95, 360.0) == Approx(0.0).margin(1e-9));
    CHECK(height_at(dem, -16.95, -179.85) == Approx(11.0));
}

TEST_CASE("a tile at the pole has its place", "[terrain][dem][stress]") {
    const Dem dem = read_dem(grid("pole", 3, 3, 0.0, 89.7, "10 10 10 20 21 22 30 31 32"));
    for (const Geodetic& place : post_places(dem)) CHECK(place.latitude_deg <= 90.0);
    CHECK_THROWS_AS(read_dem(grid("beyond", 3, 3, 0.0, 90.2, "1 2 3 4 5 6 7 8 9")), InputError);
}

TEST_CASE("what no tile covers is void and marked", "[terrain][dem][mosaic][voids]") {
    const Files tiles{grid("p", 2, 2, 8.0, 46.2, "1 1 1 1"), grid("q", 2, 2, 8.2, 46.0, "3 3 3 3")};
    CHECK_THROWS_AS(read_dem(tiles), InputError);
    const Dem dem = read_dem(tiles, {.voids = VoidPolicy::fill});
    CHECK(dem.voids == 8);
    REQUIRE(dem.is_void.size() == 16);
    CHECK(dem.is_void[0] == 0);
    CHECK(dem.is_void[2] == 1);
    for (const float h : dem.height) CHECK((h >= 1.0f && h <= 3.0f));
}

TEST_CASE("the seam of two SRTM tiles is one", "[terrain][dem][mosaic]") {
    const auto north = shared_data("data/dem/N50E011.hgt.zip");
    const auto south = shared_data("data/dem/N49E011.hgt.zip");
    if (!north || !south) return;
    const DemOptions fill{.voids = VoidPolicy::fill};
    const Dem a = read_dem(*north, fill), b = read_dem(*south, fill);
    const Dem both = read_dem(Files{*south, *north}, fill);
    CHECK(both.columns == 1201);
    CHECK(both.rows == 2401);
    CHECK(both.notes.empty());
    CHECK(both.at(0, 600) == a.at(0, 600));
    CHECK(both.at(1200, 77) == a.at(1200, 77));
    CHECK(both.at(1200, 77) == b.at(0, 77));
    CHECK(both.at(2400, 1200) == b.at(1200, 1200));
    // A window over the seam: one network, no seam at all.
    const Dem window =
        read_dem(Files{*south, *north},
                 {.voids = VoidPolicy::fill, .centre = Geodetic{50.0, 11.5, 0}, .radius = 5e3});
    const TinCheck found = check_tin(window, triangulate(window, 2.0));
    CHECK(found.worst_error <= 2.0 + 1e-6);
    CHECK(found.uncovered_posts == 0);
}

TEST_CASE("EGM96 is at the heights of PROJ's grid", "[terrain][dem][geoid][by_comparison]") {
    // Bilinear values of egm96_15; NGA's own test points lie within 5 cm of them.
    const std::vector<Geodetic> places{{38.628155, -90.220845, 0}, {-14.621217, -54.978886, 0},
                                       {46.874319, 102.448729, 0}, {-23.617446, 133.874712, 0},
                                       {38.625473, -0.0005, 0},    {-0.466744, 0.0023, 0}};
    const std::vector<double> geoid = geoid_heights(places);
    const double expected[] = {-31.609, -2.966, -43.617, 15.927, 50.036, 17.336};
    for (std::size_t i = 0; i < 6; ++i) CHECK(geoid[i] == Approx(expected[i]).margin(0.002));

    const std::filesystem::path file = DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif";
    const Dem sea = read_dem(file), ellipsoid = read_dem(file, {.geoid = true});
    const auto posts = post_places(sea);
    const std::vector<double> direct = geoid_heights(posts);
    double worst = 0.0;
    for (std::size_t i = 0; i < posts.size(); ++i) {
        worst = std::max(worst, std::abs(ellipsoid.height[i] - sea.height[i] - direct[i]));
    }
    CHECK(worst < 0.01);
}

TEST_CASE("an uncertain datum is reported with its effect", "[terrain][dem]") {
    const auto file = shared_data("data/dem/holyrood_dsm_2p5m_osgb.tif");
    if (!file) return;
    const Dem dem = read_dem(*file, {.voids = VoidPolicy::fill});
    REQUIRE(dem.notes.size() == 1);
    CHECK(dem.notes.front().find("shift of") != std::string::npos);
    CHECK(read_dem(DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif").notes.empty());
}

TEST_CASE("a raster in UTM places its posts to the millimetre", "[terrain][dem][geodesy]") {
    // GeographicLib's UTMUPS::Forward, given to the millimetre; cells of one metre.
    Dem dem;
    dem.columns = dem.rows = 1000;
    dem.transform = {423000.0, 1.0, 0.0, 5151000.0, 0.0, -1.0};
    dem.crs_wkt = "EPSG:32632";
    const std::vector<Geodetic> places{{46.5, 8.0, 0.0}, {60.0, 11.999, 0.0}};
    const double east[] = {423268.310, 667239.082}, north[] = {5150089.104, 6655202.954};
    const auto found = raster_places(dem, places);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(found[i].x() == Approx(east[i] - 423000.0 - 0.5).epsilon(0).margin(1e-3));
        CHECK(found[i].y() == Approx(5151000.0 - north[i] - 0.5).epsilon(0).margin(1e-3));
    }
    const std::vector<float> height{0.0f, 0.0f};
    const auto back = geodetic_places(dem, found, height);
    for (std::size_t i = 0; i < 2; ++i) {
        CHECK(back[i].latitude_deg ==
              Approx(places[i].latitude_deg).epsilon(0).margin(9e-9));  // 1 mm
        CHECK(back[i].longitude_deg == Approx(places[i].longitude_deg).epsilon(0).margin(9e-9));
    }
}
