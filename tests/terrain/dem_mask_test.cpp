#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "terrain/raster/class_raster.hpp"
#include "terrain/raster/raster_facts.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/scratch_folder.hpp"

// Voids by an internal mask, written here byte by byte after TIFF 6.0 and GeoTIFF 1.1.

using namespace diurna;

namespace {

constexpr int columns = 16, rows = 4;

class Bytes {
 public:
    std::string text;
    void u16(unsigned v) { put(v, 2); }
    void u32(unsigned v) { put(v, 4); }
    void real(double v) { text.append(reinterpret_cast<const char*>(&v), 8); }
    unsigned size() const { return unsigned(text.size()); }

 private:
    void put(unsigned v, int bytes) {
        for (int i = 0; i < bytes; ++i) text += char(v >> (8 * i) & 0xFF);
    }
};

struct Tag {
    unsigned tag, type, count, value;  // type 3: 16 bits, 4: 32 bits, 12: double
};

void directory(Bytes& out, const std::vector<Tag>& tags, bool more) {
    const unsigned begin = out.size();
    out.u16(unsigned(tags.size()));
    for (const Tag& t : tags) {
        out.u16(t.tag);
        out.u16(t.type);
        out.u32(t.count);
        out.u32(t.value);
    }
    out.u32(more ? begin + 2 + 12 * unsigned(tags.size()) + 4 : 0);
}

/// 16 x 4 posts of 10 m in UTM zone 16 north, 100 m high in the first column and 1 m more in each
/// next one; the mask leaves the first 8 columns out.
void masked_tiff(const std::filesystem::path& file) {
    Bytes out;
    out.text = "II*";
    out.text += '\0';
    out.u32(0);  // set below
    const unsigned heights = out.size();
    for (int i = 0; i < columns * rows; ++i) out.u16(unsigned(100 + i % columns));
    const unsigned mask = out.size();
    for (int row = 0; row < rows; ++row) out.u16(0xFF00);  // bytes 00 FF: the first bit is leftmost
    const unsigned scale = out.size();
    for (const double v : {10.0, 10.0, 0.0}) out.real(v);
    const unsigned tie = out.size();
    for (const double v : {0.0, 0.0, 0.0, 750000.0, 4020000.0, 0.0}) out.real(v);
    const unsigned keys = out.size();
    for (const unsigned v : {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32616}) {
        out.u16(v);
    }
    const unsigned first = out.size();
    directory(out,
              {{256, 3, 1, columns},
               {257, 3, 1, rows},
               {258, 3, 1, 16},
               {259, 3, 1, 1},
               {262, 3, 1, 1},
               {273, 4, 1, heights},
               {277, 3, 1, 1},
               {278, 3, 1, rows},
               {279, 4, 1, 2 * columns * rows},
               {339, 3, 1, 2},
               {33550, 12, 3, scale},
               {33922, 12, 6, tie},
               {34735, 3, 16, keys}},
              true);
    directory(out,
              {{254, 4, 1, 4},  // a transparency mask
               {256, 3, 1, columns},
               {257, 3, 1, rows},
               {258, 3, 1, 1},
               {259, 3, 1, 1},
               {262, 3, 1, 4},
               {273, 4, 1, mask},
               {277, 3, 1, 1},
               {278, 3, 1, rows},
               {279, 4, 1, 2 * rows}},
              false);
    for (int i = 0; i < 4; ++i) out.text[std::size_t(4 + i)] = char(first >> (8 * i) & 0xFF);
    std::ofstream(file, std::ios::binary) << out.text;
}

}  // namespace

TEST_CASE("posts that an internal mask excludes have no elevation", "[terrain][dem][voids]") {
    const ScratchFolder folder("dem_mask");
    const auto file = folder.path / "masked.tif";
    masked_tiff(file);
    const Dem dem = read_dem(file, {.voids = VoidPolicy::leave});
    CHECK(dem.voids == std::size_t(8 * rows));
    CHECK(std::isnan(dem.at(0, 7)));
    CHECK(dem.at(0, 8) == 108.0f);
    CHECK_THROWS_WITH(read_dem(file), Catch::Contains("no elevation"));
    // Filled from the half that is there: not from the heights below the mask, 100 to 107 m.
    CHECK(read_dem(file, {.voids = VoidPolicy::fill}).at(0, 0) >= 108.0f);

    const RasterFacts facts = read_raster_facts(file);
    CHECK(facts.band.front().valid == 8 * rows);
    CHECK(facts.band.front().least == 108.0);

    const ClassRaster classes = read_class_raster(file);
    CHECK(classes.value[7] == no_class);
    CHECK(classes.value[8] == 108);
}

TEST_CASE("a picture in colours is refused as classes", "[terrain][land_cover]") {
    // 2 x 2 pixels of red, green and blue (TIFF 6.0, photometric interpretation 2).
    Bytes out;
    out.text = "II*";
    out.text += '\0';
    out.u32(0);  // set below
    const unsigned pixels = out.size();
    for (int i = 0; i < 2 * 2 * 3; i += 2) out.u16(0x320A);
    const unsigned bits = out.size();
    for (int band = 0; band < 3; ++band) out.u16(8);
    const unsigned scale = out.size();
    for (const double v : {10.0, 10.0, 0.0}) out.real(v);
    const unsigned tie = out.size();
    for (const double v : {0.0, 0.0, 0.0, 750000.0, 4020000.0, 0.0}) out.real(v);
    const unsigned keys = out.size();
    for (const unsigned v : {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32616}) {
        out.u16(v);
    }
    const unsigned first = out.size();
    directory(out,
              {{256, 3, 1, 2},
               {257, 3, 1, 2},
               {258, 3, 3, bits},
               {259, 3, 1, 1},
               {262, 3, 1, 2},
               {273, 4, 1, pixels},
               {277, 3, 1, 3},
               {278, 3, 1, 2},
               {279, 4, 1, 2 * 2 * 3},
               {33550, 12, 3, scale},
               {33922, 12, 6, tie},
               {34735, 3, 16, keys}},
              false);
    for (int i = 0; i < 4; ++i) out.text[std::size_t(4 + i)] = char(first >> (8 * i) & 0xFF);
    const ScratchFolder folder("picture_classes");
    const auto file = folder.path / "map.tif";
    std::ofstream(file, std::ios::binary) << out.text;
    CHECK_THROWS_WITH(read_class_raster(file), Catch::Contains("map.tif") &&
                                                   Catch::Contains("3 bands of colour") &&
                                                   Catch::Contains("one band of class numbers"));
}
