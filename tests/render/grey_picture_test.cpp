#include <gdal_priv.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <limits>
#include <memory>
#include <set>
#include <vector>

#include "render/picture/grey_picture.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;

namespace {

/// Apparent temperatures of 300 to 300.5 K, one that is beyond 16 bits of 0.01 K and one that is
/// none.
Frame warm_frame() {
    Frame frame;
    frame.width = 3;
    frame.height = 2;
    frame.planes = {{.name = "apparent_temperature.8-12",
                     .unit = "K",
                     .pixel = {300.0f, 300.004f, 300.007f, 300.5f, 700.0f,
                               std::numeric_limits<float>::quiet_NaN()}}};
    return frame;
}

}  // namespace

// Read back by a library of others.
TEST_CASE("grey TIFFs and PNGs hold the counts and their scale", "[render]") {
    GDALAllRegister();
    const ScratchFolder folder("grey");
    const GreyPicture picture = grey_picture_of(warm_frame(), "apparent_temperature.8-12", 16);
    const std::vector<std::uint16_t> expected = {30000, 30000, 30001, 30050, 65535, 0};
    CHECK(picture.count == expected);
    for (const GreyFormat format : {GreyFormat::tiff, GreyFormat::png}) {
        const auto file = folder.path / ("grey" + extension_of(format));
        write_grey_picture(file, picture, format);
        const std::unique_ptr<GDALDataset> set(
            GDALDataset::FromHandle(GDALOpen(file.c_str(), GA_ReadOnly)));
        REQUIRE(set);
        REQUIRE(set->GetRasterXSize() == 3);
        REQUIRE(set->GetRasterYSize() == 2);
        REQUIRE(set->GetRasterCount() == 1);
        GDALRasterBand* band = set->GetRasterBand(1);
        CHECK(band->GetRasterDataType() == GDT_UInt16);
        std::vector<std::uint16_t> count(6);
        REQUIRE(band->RasterIO(GF_Read, 0, 0, 3, 2, count.data(), 3, 2, GDT_UInt16, 0, 0) ==
                CE_None);
        CHECK(count == expected);
        const char* key = format == GreyFormat::tiff ? "TIFFTAG_IMAGEDESCRIPTION" : "Scale";
        const char* says = set->GetMetadataItem(key);
        REQUIRE(says != nullptr);
        CHECK(std::string(says) == "K = 0 + 0.01 count");
    }
}

TEST_CASE("a grey picture says how many pixels its scale does not hold", "[render]") {
    // 65535 counts of 0.01 K end at 655.35 K: an exhaust's 700 K is beyond, a sky's 655.352 is not.
    Frame frame = warm_frame();
    frame.planes.front().pixel = {300.0F, 655.352F, 655.36F, 700.0F, std::nanf(""), 200.0F};
    const GreyPicture picture = grey_picture_of(frame, "apparent_temperature.8-12", 16);
    CHECK(picture.beyond == 2);
    CHECK(picture.count[2] == 65535);
    CHECK(picture.count[3] == 65535);
}

TEST_CASE("a grey TIFF of eight bits has a byte a pixel", "[render]") {
    GDALAllRegister();
    const ScratchFolder folder("grey");
    const GreyPicture picture{.width = 2,
                              .height = 2,
                              .bits = 8,
                              .count = {0, 17, 200, 255},
                              .scale = "K = 250 + 0.2 count"};
    const auto file = folder.path / "grey.tif";
    write_grey_picture(file, picture, GreyFormat::tiff);
    const std::unique_ptr<GDALDataset> set(
        GDALDataset::FromHandle(GDALOpen(file.c_str(), GA_ReadOnly)));
    REQUIRE(set);
    GDALRasterBand* band = set->GetRasterBand(1);
    CHECK(band->GetRasterDataType() == GDT_Byte);
    std::vector<std::uint8_t> count(4);
    REQUIRE(band->RasterIO(GF_Read, 0, 0, 2, 2, count.data(), 2, 2, GDT_Byte, 0, 0) == CE_None);
    CHECK(count == std::vector<std::uint8_t>{0, 17, 200, 255});
}

// A scene of 20 K: 2000 of 65536 counts, of which the upper 8 bits tell 8 or 9 apart.
TEST_CASE("8 bits keep a scene's contrast, 16 bits do once they are stretched", "[render]") {
    Frame frame;
    frame.width = 200;
    frame.height = 10;
    Plane plane{.name = "apparent_temperature.8-12", .unit = "K", .pixel = {}};
    for (int p = 0; p < 2000; ++p) plane.pixel.push_back(285.0F + 0.01F * float(p));
    frame.planes = {plane};
    const auto levels = [&](const GreyPicture& picture, auto&& shown) {
        std::set<int> all;
        for (const std::uint16_t count : picture.count) all.insert(shown(count));
        return all.size();
    };
    const auto upper = [](int bits) {
        return [bits](std::uint16_t count) { return bits == 16 ? count >> 8 : int(count); };
    };
    const GreyPicture narrow = grey_picture_of(frame, plane.name, 8),
                      wide = grey_picture_of(frame, plane.name, 16);
    CHECK(levels(narrow, upper(8)) > 200);
    CHECK(levels(wide, upper(16)) < 11);
    const DisplayCounts display = display_counts(frame, plane.name, 16);
    CHECK(display.black == Approx(28500).margin(100));
    CHECK(display.white == Approx(30500).margin(100));
    CHECK(levels(wide, [&](std::uint16_t count) {
              return std::clamp(255 * (count - display.black) / (display.white - display.black), 0,
                                255);
          }) > 200);
    CHECK(display_counts(frame, plane.name, 8).white == 255);
}
