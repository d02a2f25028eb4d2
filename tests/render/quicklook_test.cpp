#include "render/picture/quicklook.hpp"

#include <png.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "render/picture/bitmap_font.hpp"
#include "render/picture/palette.hpp"

using namespace diurna;

namespace {

/// A ramp from 0 to 100 °C along the columns, and a corner without data.
Frame ramp() {
    Frame frame;
    frame.width = 256;
    frame.height = 128;
    frame.observer = "ridge";
    frame.instant = parse_instant("2026-07-01T05:00:00Z");
    Plane plane{"apparent_temperature.8-12", "K", {}};
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            plane.pixel.push_back(273.15f + 100.0f * static_cast<float>(x) / 255.0f);
        }
    }
    plane.pixel[0] = std::numeric_limits<float>::quiet_NaN();
    frame.planes.push_back(std::move(plane));
    return frame;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    }
    return value;
}

/// L* of an sRGB colour.
double lightness(const std::string& bytes, std::size_t at) {
    const double weight[] = {0.2126729, 0.7151522, 0.0721750};
    double y = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double v = static_cast<unsigned char>(bytes[at + i]) / 255.0;
        y += weight[i] * (v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
    }
    return 116.0 * std::cbrt(y) - 16.0;
}

}  // namespace

TEST_CASE("a quick-look is a PNG whose palette rises evenly in lightness", "[render][quicklook]") {
    const auto path = std::filesystem::temp_directory_path() /
                      ("diurna_quicklook_" + std::to_string(std::random_device{}()) + ".png");
    write_quicklook(path, ramp(), "apparent_temperature.8-12");
    const std::string bytes = read_text(path);
    std::filesystem::remove(path);
    REQUIRE(bytes.substr(0, 8) == "\x89PNG\r\n\x1a\n");
    CHECK(big_endian(bytes, 16) > 256);  // width: picture and colour bar
    CHECK(big_endian(bytes, 20) > 128);
    const std::size_t palette = bytes.find("PLTE");
    REQUIRE(palette != std::string::npos);
    for (std::size_t i = 1; i < 250; ++i) {
        const double step =
            lightness(bytes, palette + 4 + 3 * i) - lightness(bytes, palette + 4 + 3 * (i - 1));
        CAPTURE(i, step);
        // 87 units of lightness in 249 steps, and half a unit from rounding to 8 bits.
        CHECK(step > -0.2);
        CHECK(step < 1.0);
    }
    const double span = lightness(bytes, palette + 4 + 3 * 249) - lightness(bytes, palette + 4);
    CHECK(span == Approx(87.0).margin(1.5));
}

TEST_CASE("the colour scale omits the extreme hundredths", "[render][quicklook]") {
    const ColourScale scale = colour_scale(ramp().planes[0]);
    // Columns 2 and 253 of 256: 0.78 °C and 99.2 °C, widened to whole degrees.
    CHECK(scale.low == 0.0);
    CHECK(scale.high == 100.0);
    CHECK(colour_scale({"empty", "K", {}}).high > colour_scale({"empty", "K", {}}).low);
    CHECK(colour_scale({"flat", "K", std::vector<float>(9, 300.0f)}).high == 27.0);
}

TEST_CASE("a plane that is not there is refused", "[render][quicklook][input]") {
    CHECK_THROWS_AS(write_quicklook("q.png", ramp(), "apparent_temperature.3-5"), InputError);
}

TEST_CASE("a band that sunlight rules is shown as radiance, in greys of light",
          "[render][quicklook]") {
    CHECK(shown_plane(flat_band("visible", 0.4, 0.7)) == "radiance.visible");
    CHECK(shown_plane(flat_band("1.5-1.8", 1.5, 1.8)) == "radiance.1.5-1.8");
    CHECK(shown_plane(flat_band("3-5", 3.0, 5.0)) == "apparent_temperature.3-5");
    Plane light{"radiance.visible", "W m-2 sr-1", std::vector<float>(100, 20.0f)};
    light.pixel[7] = 1e4f;  // a glint
    CHECK(colour_scale(light).low == 0.0);
    CHECK(colour_scale(light).high == 20.0);
    CHECK(colour_unit(light) == "W m-2 sr-1");
    // Before dawn nothing is seen, rather than 1e-20 W of emission in full colours.
    light.pixel.assign(100, 1e-20f);
    CHECK(colour_scale(light).high == 1e-6);
    // IEC 61966-2-1: half the light of white is 188, 1 % of it 25.
    CHECK(grey_of_light(0.0) == Rgb{0, 0, 0});
    CHECK(grey_of_light(0.01)[0] == 25);
    CHECK(grey_of_light(0.5)[1] == 188);
    CHECK(grey_of_light(1.0) == Rgb{255, 255, 255});
}

TEST_CASE("letters differ from each other, and unknown ones show as a box", "[render][quicklook]") {
    std::string all = "!%()+,-./:=_";
    for (char c = '0'; c <= '9'; ++c) all += c;
    for (char c = 'A'; c <= 'Z'; ++c) all += c;
    for (char c = 'a'; c <= 'z'; ++c) all += c;
    auto glyphs = glyphs_of(all + "°µ");
    REQUIRE(glyphs.size() == all.size() + 2);
    const Glyph unknown = glyphs_of("é").at(0);
    for (const Glyph& glyph : glyphs) CHECK(glyph != unknown);
    std::sort(glyphs.begin(), glyphs.end());
    CHECK(std::adjacent_find(glyphs.begin(), glyphs.end()) == glyphs.end());
}

TEST_CASE("the sky does not take up the colours", "[render][quicklook]") {
    Frame frame;
    frame.width = 20;
    frame.height = 10;
    Plane apparent{"apparent_temperature.8-12", "K", std::vector<float>(200, 230.0f)};
    Plane solid{"temperature", "K", std::vector<float>(200, std::nanf(""))};
    for (std::size_t p = 100; p < 200; ++p) {
        apparent.pixel[p] = 293.15f + 0.1f * float(p - 100);
        solid.pixel[p] = 300.0f;
    }
    frame.planes = {apparent};
    CHECK(colour_scale(frame, apparent.name).low < -40.0);
    frame.planes = {apparent, solid};
    const ColourScale scale = colour_scale(frame, apparent.name);
    CHECK(scale.low == Approx(20.0).margin(1.0));
    CHECK(scale.high == Approx(30.0).margin(1.0));
}

namespace {

/// Palette indices would be coded differently in each file; so the pixels [red, green, blue].
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb{};

    /// Whether a rectangle holds a pixel of the text's colour.
    bool inked(int left, int top, int right, int bottom) const {
        for (int y = top; y < std::min(bottom, height); ++y) {
            for (int x = left; x < std::min(right, width); ++x) {
                const auto at = 3 * (std::size_t(y) * std::size_t(width) + std::size_t(x));
                if (rgb[at] == 232 && rgb[at + 1] == 232 && rgb[at + 2] == 228) return true;
            }
        }
        return false;
    }
};

Pixels quicklook_of(const Frame& frame) {
    const auto path = std::filesystem::temp_directory_path() /
                      ("diurna_quicklook_" + std::to_string(std::random_device{}()) + ".png");
    write_quicklook(path, frame, frame.planes.front().name);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&image, path.c_str()));
    image.format = PNG_FORMAT_RGB;
    Pixels pixels{int(image.width), int(image.height), {}};
    pixels.rgb.resize(PNG_IMAGE_SIZE(image));
    REQUIRE(png_image_finish_read(&image, nullptr, pixels.rgb.data(), 0, nullptr));
    std::filesystem::remove(path);
    return pixels;
}

}  // namespace

TEST_CASE("the title of a small quick-look stays beside the scale's unit", "[render][quicklook]") {
    for (const auto& [width, height] :
         {std::pair{128, 96}, {64, 64}, {16, 16}, {256, 128}, {640, 512}}) {
        CAPTURE(width, height);
        Frame frame;
        frame.width = width;
        frame.height = height;
        frame.observer = "generator_east";
        frame.instant = parse_instant("2026-07-15T04:00:00Z");
        Plane plane{"radiance.8-12", "W m-2 sr-1", {}};
        for (int i = 0; i < width * height; ++i) {
            plane.pixel.push_back(1e-5f * static_cast<float>(i) /
                                  static_cast<float>(width * height));
        }
        frame.planes = {plane};
        const Pixels pixels = quicklook_of(frame);
        // Above the picture; the unit begins 14 pixels to the right of the picture.
        const int picture = 10 + std::max(width, 64);
        CHECK(pixels.inked(0, 0, picture, 42));                        // the title
        CHECK_FALSE(pixels.inked(picture + 10, 0, picture + 14, 42));  // and a gap behind it
        CHECK_FALSE(pixels.inked(picture + 14, 0, pixels.width, 17));  // only the unit there
        CHECK(pixels.inked(picture + 14, 17, pixels.width, 42));
        // No number reaches the picture's right edge: it would be cut.
        CHECK_FALSE(pixels.inked(pixels.width - 1, 0, pixels.width, pixels.height));
    }
}
