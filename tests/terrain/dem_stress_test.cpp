#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <random>
#include <sstream>

#include "materials/base/error.hpp"
#include "terrain/ground/triangulate.hpp"
#include "terrain/raster/geotiff.hpp"
#include "terrain/raster/read_dem.hpp"
#include "terrain/relief/height_field.hpp"
#include "terrain/relief/horizon.hpp"
#include "terrain/relief/relief_sky.hpp"
#include "tests/support/even_field.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_data.hpp"

// Rasters that are wrong: a clear error or a right answer, never a hang or a crash.

using namespace diurna;

namespace {

const ScratchFolder scratch("dem-stress");

std::filesystem::path file(const std::string& name, const std::string& bytes) {
    const auto path = scratch.path / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

std::string refusal(const std::filesystem::path& path, const DemOptions& options = {}) {
    try {
        read_dem(path, options);
    } catch (const InputError& error) {
        const std::string line = error.what();
        CHECK(std::count(line.begin(), line.end(), '\n') <= 1);
        return line;
    }
    return "";
}

/// A raster of equal steps with the given first corner.
Dem made(const std::string& crs, double x, double y, double step, int columns, int rows) {
    Dem dem;
    dem.source = "made";
    dem.columns = columns;
    dem.rows = rows;
    dem.transform = {x, step, 0.0, y, 0.0, -step};
    dem.crs_wkt = crs;
    for (int i = 0; i < columns * rows; ++i) dem.height.push_back(float(100 + i % 7));
    return dem;
}

std::filesystem::path written(const std::string& name, const Dem& dem) {
    write_geotiff(scratch.path / name, dem, {{"height", dem.height}});
    return scratch.path / name;
}

std::string ascii(double cell_size) {
    return "ncols 2\nnrows 2\nxllcorner 8\nyllcorner 46\ncellsize " + std::to_string(cell_size) +
           "\n1 2\n3 4\n";
}

/// A little-endian TIFF of side × side floats, as it says, with one strip of four bytes.
std::string claim(std::uint32_t side) {
    std::string bytes("II*\0\x08\0\0\0", 8);
    const auto put = [&](auto value) {
        bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    };
    struct Tag {
        std::uint16_t id, type;
        std::uint32_t count, value;
    };
    const Tag tags[] = {{256, 4, 1, side}, {257, 4, 1, side}, {258, 3, 1, 32}, {259, 3, 1, 1},
                        {262, 3, 1, 1},    {273, 4, 1, 8},    {277, 3, 1, 1},  {278, 4, 1, side},
                        {279, 4, 1, 4},    {339, 3, 1, 3}};
    put(static_cast<std::uint16_t>(std::size(tags)));
    for (const Tag& tag : tags) {
        put(tag.id);
        put(tag.type);
        put(tag.count);
        put(tag.value);
    }
    put(std::uint32_t{0});
    return bytes;
}

}  // namespace

TEST_CASE("a header that claims more than its file holds is refused at once",
          "[terrain][dem][stress]") {
    for (const std::uint32_t side : {200000u, 2000000000u}) {
        const std::string line = refusal(file("huge.tif", claim(side)));
        CAPTURE(side, line);
        CHECK((line.find("at most 500 million") != std::string::npos ||
               line.find("claims") != std::string::npos ||
               line.find("cannot be read") != std::string::npos));
    }
    // The same claim in text, which costs nothing to write.
    CHECK_FALSE(refusal(file("huge.asc",
                             "ncols 2000000000\nnrows 2000000000\nxllcorner 8\nyllcorner 46\n"
                             "cellsize 0.1\n1 2 3 4\n"))
                    .empty());
}

TEST_CASE("cells without size are refused", "[terrain][dem][stress]") {
    for (const double size : {0.0, -1.0, std::nan("")}) {
        file("cells.prj",
             "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,"
             "298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925]]");
        CAPTURE(size);
        CHECK_FALSE(refusal(file("cells.asc", ascii(size))).empty());
    }
}

TEST_CASE("a raster far from its UTM zone is reported", "[terrain][dem][stress]") {
    const Dem right = read_dem(written("right.tif", made("EPSG:32616", 750e3, 4020e3, 30, 20, 20)));
    CHECK(right.notes.empty());
    // Cumberland in zone 16 with the eastings of zone 16 named 11 is where Nevada is: that cannot
    // be reported; eastings of 2000 km or the southern hemisphere's northings can.
    for (const auto& dem : {made("EPSG:32611", 1.5e6, 4020e3, 30, 20, 20),
                            made("EPSG:32716", 750e3, 10.5e6, 30, 20, 20)}) {
        const Dem wrong = read_dem(written("wrong.tif", dem));
        REQUIRE(wrong.notes.size() == 1);
        CHECK(wrong.notes[0].find("check the zone") != std::string::npos);
    }
}

TEST_CASE("whatever bytes of a GeoTIFF are wrong, it is read or refused",
          "[terrain][dem][stress]") {
    std::ostringstream text;
    text << std::ifstream(written("sound.tif", made("EPSG:32616", 750e3, 4020e3, 30, 40, 30)),
                          std::ios::binary)
                .rdbuf();
    const std::string sound = text.str();
    REQUIRE(sound.size() > 600);
    std::mt19937 random(5);
    std::size_t refused = 0, read = 0;
    for (int k = 0; k < 400; ++k) {
        std::string bytes = sound;
        // Header, tags and GeoKeys lie at both ends.
        const std::size_t reach = std::min<std::size_t>(bytes.size() / 2, 500);
        for (int flips = 1 + k % 4; flips > 0; --flips) {
            const std::size_t at = random() % reach;
            bytes[random() % 2 ? at : bytes.size() - 1 - at] ^= char(1 << random() % 8);
        }
        if (k % 10 == 0) bytes.resize(random() % bytes.size());
        try {
            const Dem dem = read_dem(file("flipped.tif", bytes), {.voids = VoidPolicy::fill});
            ++read;
            CHECK(dem.height.size() == std::size_t(dem.columns) * std::size_t(dem.rows));
            for (const float h : dem.height) REQUIRE((h > -12e3f && h < 10e3f));
        } catch (const InputError&) {
            ++refused;
        }
    }
    CAPTURE(refused, read);
    CHECK(refused > 20);
    CHECK(read > 20);
}

TEST_CASE("corrupt GeoKeys of a real file are refused, not guessed",
          "[terrain][dem][stress][samples]") {
    const auto sample = shared_data("data/dem/sba_airport_elev32_512.tif");
    if (!sample) return;
    const std::string line = refusal(*sample, {.voids = VoidPolicy::fill});
    CAPTURE(line);
    CHECK_FALSE(line.empty());
}

TEST_CASE("a constant surface is two triangles under the whole sky",
          "[terrain][dem][stress][by_degenerate]") {
    Dem dem = made("EPSG:32616", 750e3, 4020e3, 30, 25, 17);
    std::fill(dem.height.begin(), dem.height.end(), 250.0f);
    const Dem level = read_dem(written("level.tif", dem));
    CHECK(triangulate(level, 0.0).triangle.size() == 2);
    const HeightField field = even_field(25, 17, level.height, 30.0);
    std::vector<float> sky(field.size()), tangent(field.size());
    sky_view(field, 8, sky);
    horizon(field, 37.0, tangent);
    for (std::size_t p = 0; p < sky.size(); ++p) {
        CHECK(sky[p] == Approx(1.0f).margin(1e-5));
        CHECK(tangent[p] == 0.0f);
    }
}

TEST_CASE("one void among good posts is filled without a pit", "[terrain][dem][stress][voids]") {
    for (const float code : {-32768.0f, -32767.0f, -9999.0f, 32767.0f, std::nanf("")}) {
        Dem dem = made("EPSG:32616", 750e3, 4020e3, 30, 25, 17);
        dem.height[8 * 25 + 12] = code;
        const auto path = written("one.tif", dem);
        CHECK_FALSE(refusal(path).empty());
        const Dem filled = read_dem(path, {.voids = VoidPolicy::fill});
        CHECK(filled.voids == 1);
        CHECK(filled.at(8, 12) >= 100.0f);
        CHECK(filled.at(8, 12) <= 106.0f);
        CHECK(filled.is_void[8 * 25 + 12] == 1);
    }
}
