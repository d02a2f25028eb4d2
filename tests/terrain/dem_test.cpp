#include "terrain/raster/read_dem.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <fstream>

#include "materials/base/error.hpp"
#include "terrain/raster/dem_places.hpp"
#include "tests/support/post_places.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_data.hpp"

using namespace diurna;

namespace {

const PrivateTempFolder private_temp_folder;

const std::filesystem::path jacksboro = DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif";

/// An ESRI ASCII grid with a .prj, gone again at the end.
class AsciiGrid {
 public:
    explicit AsciiGrid(const std::string& text, const std::string& crs = wgs84)
        : folder_(std::filesystem::temp_directory_path() /
                  ("diurna_dem_test_" + std::to_string(std::rand()))) {
        std::filesystem::create_directories(folder_);
        std::ofstream(file()) << text;
        if (!crs.empty()) std::ofstream(folder_ / "grid.prj") << crs;
    }
    ~AsciiGrid() { std::filesystem::remove_all(folder_); }
    std::filesystem::path file() const { return folder_ / "grid.asc"; }

    static constexpr const char* wgs84 =
        "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
        "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]";

 private:
    std::filesystem::path folder_;
};

std::string grid(int columns, int rows, const std::string& values, double cell = 0.1,
                 double west = 8.0, double south = 46.0) {
    return "ncols " + std::to_string(columns) + "\nnrows " + std::to_string(rows) + "\nxllcorner " +
           std::to_string(west) + "\nyllcorner " + std::to_string(south) + "\ncellsize " +
           std::to_string(cell) + "\nNODATA_value -99\n" + values + "\n";
}

std::string refusal(const std::filesystem::path& file, const DemOptions& options = {}) {
    try {
        read_dem(file, options);
    } catch (const InputError& error) {
        const std::string line = error.what();
        CHECK(line.find('\n') == std::string::npos);
        return line;
    }
    return "accepted";
}

struct Range {
    float low = 1e9f, high = -1e9f;
};
Range range(const Dem& dem) {
    Range r;
    for (const float h : dem.height) {
        if (std::isnan(h)) continue;
        r.low = std::min(r.low, h);
        r.high = std::max(r.high, h);
    }
    return r;
}

}  // namespace

TEST_CASE("Jacksboro's highest post stands on Cross Mountain", "[terrain][dem]") {
    const Dem dem = read_dem(jacksboro);
    CHECK(dem.columns == 403);
    CHECK(dem.rows == 344);
    CHECK(dem.voids == 0);
    CHECK(range(dem).low == 236.0f);
    CHECK(range(dem).high == 1076.0f);

    // Cross Mountain: 36.19833° N, 84.23056° W (Wikipedia, from the USGS). Posts are 3″ apart.
    const auto places = post_places(dem);
    const auto top = std::max_element(dem.height.begin(), dem.height.end());
    const Geodetic& summit = places[static_cast<std::size_t>(top - dem.height.begin())];
    CHECK(summit.latitude_deg == Approx(36.19833).margin(1.0 / 1200));
    CHECK(summit.longitude_deg == Approx(-84.23056).margin(1.0 / 1200));

    // Posts of SRTM's 3″ lattice fall on whole 3″.
    CHECK(std::abs(std::remainder(places[0].latitude_deg * 1200.0, 1.0)) < 1e-6);
    CHECK(std::abs(std::remainder(places[0].longitude_deg * 1200.0, 1.0)) < 1e-6);

    // A minute of latitude at 36.3° is 1849.3 m, one of longitude 1496.1 m (WGS84 tables).
    const Eigen::Vector2d spacing = post_spacing(dem);
    CHECK(spacing.x() == Approx(1496.1 / 20).epsilon(1e-3));
    CHECK(spacing.y() == Approx(1849.3 / 20).epsilon(1e-3));
}

TEST_CASE("a place converts into the raster and back", "[terrain][dem]") {
    const Dem dem = read_dem(jacksboro);
    const Site site{36.3, -84.2, 400.0};
    const std::vector<Eigen::Vector2d> east_north{{0, 0}, {2500, -7000}, {-9000, 8000}};
    const auto raster = raster_places(dem, site, east_north);
    std::vector<float> height;
    for (const auto& place : raster) height.push_back(static_cast<float>(height_at(dem, place)));
    const auto local = local_vertices(dem, site, raster, height);
    for (std::size_t i = 0; i < local.size(); ++i) {
        CHECK((local[i].head<2>() - east_north[i]).norm() < 1e-3);
    }
    const Geodetic there = geodetic_places(dem, raster, height).front();
    CHECK(height_at(dem, there.latitude_deg, there.longitude_deg) ==
          Approx(height[0]).epsilon(1e-6));
}

TEST_CASE("between posts heights are bilinear, outside and beside voids unknown",
          "[terrain][dem]") {
    const AsciiGrid file(grid(3, 2, "10 20 30\n 40 50 -99"));
    const Dem dem = read_dem(file.file(), {.voids = VoidPolicy::leave});
    CHECK(dem.voids == 1);
    CHECK(height_at(dem, Eigen::Vector2d(0.5, 0.5)) == Approx(30.0));
    CHECK(height_at(dem, Eigen::Vector2d(0.25, 0.0)) == Approx(12.5));
    CHECK(height_at(dem, Eigen::Vector2d(1.25, 0.25)) == Approx(30.0));  // plane of 20, 30, 50
    CHECK(std::isnan(height_at(dem, Eigen::Vector2d(1.75, 0.75))));
    CHECK(std::isnan(height_at(dem, Eigen::Vector2d(-0.01, 0.5))));
    CHECK(std::isnan(height_at(dem, Eigen::Vector2d(0.5, 1.01))));
    // The posts are the cells' centres: lower left corner 8° E 46° N, cells of 0.1°.
    const auto places = post_places(dem);
    CHECK(places[0].longitude_deg == Approx(8.05));
    CHECK(places[0].latitude_deg == Approx(46.15));
    CHECK(height_at(dem, 46.15, 8.15) == Approx(20.0));
}

TEST_CASE("voids are refused, left or filled as requested", "[terrain][dem]") {
    const AsciiGrid file(grid(4, 4, "1 2 3 4\n1 -99 -32768 4\n1 -9999 3 4\n1 2 3 4"));
    CHECK(refusal(file.file()).find("no elevation at 3 posts (19 %)") != std::string::npos);
    CHECK(refusal(file.file()).find("voids = \"fill\"") != std::string::npos);
    CHECK(read_dem(file.file(), {.voids = VoidPolicy::leave}).voids == 3);
    const Dem filled = read_dem(file.file(), {.voids = VoidPolicy::fill});
    for (const float h : filled.height) {
        CHECK(h >= 1.0f);
        CHECK(h <= 4.0f);
    }
    CHECK(filled.at(0, 2) == 3.0f);
}

TEST_CASE("a raster stored south first is turned over", "[terrain][dem]") {
    // ENVI's map info with a rotation of 180° would do; simplest is a header by hand: raw float
    // rows, lower left corner first, via a negative row step.
    const auto folder = std::filesystem::temp_directory_path() / "diurna_dem_south_first";
    std::filesystem::create_directories(folder);
    const std::vector<float> rows{1, 2, 3, 4, 5, 6};  // south: 1 2 3, north: 4 5 6
    std::ofstream(folder / "g.img", std::ios::binary)
        .write(reinterpret_cast<const char*>(rows.data()), 24);
    std::ofstream(folder / "g.hdr")
        << "ENVI\nsamples = 3\nlines = 2\nbands = 1\nheader offset = 0\nfile type = ENVI Standard\n"
           "data type = 4\ninterleave = bsq\nbyte order = 0\n"
           "map info = {Geographic Lat/Lon, 1, 1, 8.0, 46.0, 0.1, -0.1, WGS-84}\n";
    const Dem dem = read_dem(folder / "g.img");
    std::filesystem::remove_all(folder);
    CHECK(dem.at(0, 0) == 4.0f);
    CHECK(dem.at(1, 2) == 3.0f);
    CHECK(dem.transform[5] < 0.0);
    const auto places = post_places(dem);
    CHECK(places[0].latitude_deg == Approx(46.15));
    CHECK(places[3].latitude_deg == Approx(46.05));
}

TEST_CASE("a window holds its circle and keeps every post in place", "[terrain][dem]") {
    const Dem whole = read_dem(jacksboro);
    const Geodetic centre{36.3, -84.2, 0.0};
    const Dem part = read_dem(jacksboro, {.centre = centre, .radius = 3000.0});
    CHECK(part.columns >= 2 * 3000 / 75);
    CHECK(part.columns <= 2 * 3000 / 75 + 6);
    CHECK(part.rows >= 2 * 3000 / 93);
    CHECK(part.rows <= 2 * 3000 / 93 + 6);
    const auto places = post_places(part);
    for (const std::size_t i : {std::size_t{0}, places.size() / 2, places.size() - 1}) {
        CHECK(height_at(whole, places[i].latitude_deg, places[i].longitude_deg) ==
              Approx(part.height[i]));
    }
    CHECK(refusal(jacksboro, {.centre = Geodetic{10.0, 10.0, 0.0}, .radius = 100.0})
              .find("does not contain") != std::string::npos);
}

TEST_CASE("what cannot be used is refused in one clear line", "[terrain][dem][stress]") {
    const auto says = [](const std::string& line, const char* part) {
        CAPTURE(line, part);
        CHECK(line.find(part) != std::string::npos);
    };
    says(refusal("/no/such/file.tif"), "the file does not exist");
    says(refusal("/vsimem/x.tif"), "the file does not exist");
    says(refusal("GTIFF_DIR:1:" + jacksboro.string()), "the file does not exist");
    says(refusal(std::filesystem::temp_directory_path()), "is not a file");
    says(refusal(DIURNA_SOURCE_DIR "/CMakeLists.txt"), "cannot be read as elevation");

    const AsciiGrid nothing(""), one(grid(1, 1, "5")), line(grid(5, 1, "1 2 3 4 5"));
    says(refusal(nothing.file()), "is empty");
    says(refusal(one.file()), "has 1 x 1 posts");
    says(refusal(line.file()), "has 5 x 1 posts");
    const AsciiGrid all_void(grid(2, 2, "-99 -99 -9999 -32768"));
    says(refusal(all_void.file(), {.voids = VoidPolicy::fill}), "every post is void");
    const AsciiGrid word(grid(2, 2, "1 2 abc 4")), comma(grid(2, 2, "1 2 1,5 4"));
    says(refusal(word.file()), "found 'abc'");
    says(refusal(comma.file()), "found '1,5'");
    const AsciiGrid few(grid(2, 2, "1 2 3")), many(grid(2, 2, "1 2 3 4 5"));
    says(refusal(few.file()), "has 3 values, expected 4");
    says(refusal(many.file()), "has 5 values, expected 4");
    const AsciiGrid no_crs(grid(2, 2, "1 2 3 4"), "");
    says(refusal(no_crs.file()), "has no coordinate reference system");
    const AsciiGrid negative(grid(2, 2, "1 2 3 4", -0.1));
    says(refusal(negative.file()), "cell size");
    const AsciiGrid beyond(grid(2, 2, "1 2 3 4", 0.1, 8.0, 90.5));
    says(refusal(beyond.file()), "outside the Earth");
    const AsciiGrid high(grid(2, 2, "1 2 3 31000"));
    says(refusal(high.file()), "higher than any place on Earth");
    CHECK(range(read_dem(high.file(), {.unit = 0.01})).high == Approx(310.0));
}

TEST_CASE("sample rasters of many kinds are read rightly", "[terrain][dem][samples]") {
    struct Case {
        std::string name;
        int columns, rows;
        float low, high;
        double void_percent;
        double latitude_deg, longitude_deg;  // first post
    };
    const Case c = GENERATE(values<Case>({
        {"bigtujunga.tif", 1197, 643, 315, 2295, 0, 34.4051725623, -118.3455678957},
        {"tuolumne_albers_30m.tif", 1100, 1100, 826, 3374, 0, 37.5518655631, -119.4746471747},
        {"N43E007.hgt.zip", 1201, 1201, -11, 2064, 0.111, 44.0, 7.0},
        {"mt_everest_90m.tif", 1201, 1201, 192, 8642, 9.079, 28.0, 86.0},
        {"craterlake-elev-16bit-30m.tif", 429, 279, 1289, 1880, -1, 42.9793166448, -122.1654477032},
        {"SainteHelens.dem", 327, 468, 682, 2543, 2.712, 46.2507853295, -122.2510942768},
        {"n00_e006_3arc_v2.dt1", 1201, 1201, -7, 1979, 0.282, 1.0, 6.0},
        {"gabilan_1m.bil", 921, 859, 187.9f, 307.28f, -1, 35.9279596693, -114.8243130339},
        {"isce_dem_south_pole.tif", 211, 210, 2584.021f, 3366.898f, 0, -88.4254441031,
         92.2309138546},
    }));
    const auto file = shared_data("data/dem/" + c.name);
    if (!file) return;
    CAPTURE(c.name);
    const Dem dem = read_dem(*file, {.voids = VoidPolicy::leave});
    CHECK(dem.columns == c.columns);
    CHECK(dem.rows == c.rows);
    CHECK(range(dem).low == Approx(c.low).margin(0.06));
    CHECK(range(dem).high == Approx(c.high).margin(0.06));
    const double percent = 100.0 * double(dem.voids) / double(dem.height.size());
    if (c.void_percent >= 0) CHECK(percent == Approx(c.void_percent).margin(5e-4));
    const Eigen::Vector2d first(0, 0);
    const float zero = 0.0f;
    const Geodetic place = geodetic_places(dem, {&first, 1}, {&zero, 1}).front();
    CHECK(place.latitude_deg == Approx(c.latitude_deg).margin(1e-7));
    CHECK(place.longitude_deg == Approx(c.longitude_deg).margin(1e-7));
}
