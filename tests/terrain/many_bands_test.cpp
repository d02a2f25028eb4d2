#include <catch2/catch.hpp>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "terrain/raster/raster_facts.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;

namespace {

/// A TIFF of 16-bit zeros, 64 x 64, in tiles of 16 x 16 of which none is stored (TIFF 6.0; tags
/// 324, 325 zero), the bands one after the other, placed in UTM.
std::string sparse_tiff(int bands) {
    struct Tag {
        int type;
        std::vector<double> value;
    };
    const std::vector<double> of_bands(static_cast<std::size_t>(bands)), tiles(16.0 * bands);
    const auto all = [&](double v) { return std::vector<double>(of_bands.size(), v); };
    const std::map<int, Tag> tags{
        {256, {4, {64}}},
        {257, {4, {64}}},
        {258, {3, all(16)}},
        {259, {3, {1}}},
        {262, {3, {1}}},
        {277, {3, {double(bands)}}},
        {284, {3, {2}}},
        {322, {4, {16}}},
        {323, {4, {16}}},
        {324, {4, tiles}},
        {325, {4, tiles}},
        {339, {3, all(2)}},
        {33550, {12, {10, 10, 0}}},
        {33922, {12, {0, 0, 0, 500000, 5205000, 0}}},
        {34735, {3, {1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32632}}}};
    const auto bytes = [](auto value) {
        return std::string(reinterpret_cast<const char*>(&value), sizeof value);
    };
    std::string head = "II*" + std::string(1, '\0') + bytes(std::uint32_t{8}) +
                       bytes(static_cast<std::uint16_t>(tags.size())),
                body;
    const std::size_t first = 10 + 12 * tags.size() + 4;
    for (const auto& [tag, of] : tags) {
        std::string data;
        for (const double v : of.value) {
            data += of.type == 3   ? bytes(static_cast<std::uint16_t>(v))
                    : of.type == 4 ? bytes(static_cast<std::uint32_t>(v))
                                   : bytes(v);
        }
        head += bytes(static_cast<std::uint16_t>(tag)) +
                bytes(static_cast<std::uint16_t>(of.type)) +
                bytes(static_cast<std::uint32_t>(of.value.size()));
        if (data.size() <= 4) {
            data.resize(4, '\0');
            head += data;
        } else {
            head += bytes(static_cast<std::uint32_t>(first + body.size()));
            body += data;
        }
    }
    return head + bytes(std::uint32_t{0}) + body;
}

}  // namespace

TEST_CASE("a raster of bands without end is refused, and no more are described than anyone reads",
          "[terrain][dem][stress]") {
    const ScratchFolder folder("many-bands");
    const std::filesystem::path many = folder.path / "many.tif", some = folder.path / "some.tif";
    write_whole_file(many, sparse_tiff(5000));
    write_whole_file(some, sparse_tiff(200));
    CHECK_THROWS_WITH(read_dem(many, {.voids = VoidPolicy::leave}),
                      Catch::Contains("has 5000 bands, expected at most 4096"));
    CHECK_THROWS_AS(read_raster_facts(many), InputError);
    const RasterFacts facts = read_raster_facts(some);
    CHECK(facts.bands == 200);
    CHECK(facts.band.size() == most_bands_described);
    CHECK(read_dem(some, {.voids = VoidPolicy::leave}).columns == 64);
}
