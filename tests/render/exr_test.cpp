#include "render/picture/exr.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"

using namespace diurna;

namespace {

struct Folder {
    std::filesystem::path path = std::filesystem::temp_directory_path() /
                                 ("diurna_exr_test_" + std::to_string(std::random_device{}()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() { std::filesystem::remove_all(path); }
};

Frame noisy_frame() {
    Frame frame;
    frame.width = 37;
    frame.height = 21;
    frame.observer = "ridge";
    frame.instant = parse_instant("2026-07-01T05:00:00.250Z");
    frame.notes["error.3-5"] = "0.5 mK";
    std::mt19937 random(11);
    std::uniform_real_distribution<float> value(-1e3f, 1e3f);
    for (const char* name : {"apparent_temperature.3-5", "normal.X", "radiance.3-5"}) {
        Plane plane{name, "W m-2 sr-1", {}};
        for (std::size_t p = 0; p < frame.pixels(); ++p) plane.pixel.push_back(value(random));
        plane.pixel[3] = std::numeric_limits<float>::quiet_NaN();
        plane.pixel[4] = 16777217.0f;
        frame.planes.push_back(std::move(plane));
    }
    return frame;
}

}  // namespace

TEST_CASE("a frame comes back from its file bit by bit", "[render][exr]") {
    const Folder folder;
    const Frame frame = noisy_frame();
    const auto compression = GENERATE(ExrCompression::none, ExrCompression::zips,
                                      ExrCompression::zip, ExrCompression::piz);
    const auto path = folder.path / "frame.exr";
    write_exr(path, frame, compression);
    const Frame back = read_exr(path);
    CHECK(back.width == 37);
    CHECK(back.height == 21);
    CHECK(back.instant == frame.instant);
    CHECK(back.observer == "ridge");
    CHECK(back.notes.at("error.3-5") == "0.5 mK");
    REQUIRE(back.planes.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
        CHECK(back.planes[i].name == frame.planes[i].name);
        CHECK(back.planes[i].unit == "W m-2 sr-1");
        CHECK(std::memcmp(back.planes[i].pixel.data(), frame.planes[i].pixel.data(),
                          frame.pixels() * sizeof(float)) == 0);
    }
}

TEST_CASE("of a file the requested planes that exist are read", "[render][exr]") {
    const Folder folder;
    const auto path = folder.path / "frame.exr";
    const Frame frame = noisy_frame();
    write_exr(path, frame);
    const std::string there = frame.planes[1].name;
    CHECK(read_exr(path, std::vector<std::string>{there, "none"}).planes.size() == 1);
    const Frame none = read_exr(path, std::vector<std::string>{"none"});
    CHECK(none.planes.empty());
    CHECK(none.observer == "ridge");
}

TEST_CASE("the same frame gives the same file", "[render][exr][by_replication]") {
    const Folder folder;
    write_exr(folder.path / "a.exr", noisy_frame());
    write_exr(folder.path / "b.exr", noisy_frame());
    CHECK(read_text(folder.path / "a.exr") == read_text(folder.path / "b.exr"));
}

TEST_CASE("a missing, foreign, truncated or damaged file is refused", "[render][exr][input]") {
    const Folder folder;
    const auto path = folder.path / "frame.exr";
    CHECK_THROWS_AS(read_exr(path), InputError);
    write_exr(path, noisy_frame());
    const std::string whole = read_text(path);
    const auto refused = [&](std::string bytes) {
        write_whole_file(path, bytes);
        CHECK_THROWS_AS(read_exr(path), InputError);
    };
    refused("no picture at all");
    refused("");
    for (const double share : {0.02, 0.1, 0.3, 0.6, 0.95}) {
        CAPTURE(share);
        refused(whole.substr(0, static_cast<std::size_t>(share * double(whole.size()))));
    }
    // A picture of 60000 × 60000 in a few kilobytes: the size of the data window is a lie.
    std::string liar = whole;
    const std::size_t window = liar.find("dataWindow");
    REQUIRE(window != std::string::npos);
    const std::size_t box = window + std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4;
    const std::int32_t far = 15000;
    std::memcpy(&liar[box + 8], &far, 4);
    std::memcpy(&liar[box + 12], &far, 4);
    refused(liar);
}

TEST_CASE("a file that cannot be written is reported by its path", "[render][exr][input]") {
    CHECK_THROWS_WITH(write_exr("/no/such/folder/frame.exr", noisy_frame()),
                      Catch::Contains("frame.exr"));
    Frame frame = noisy_frame();
    frame.planes[0].pixel.pop_back();
    CHECK_THROWS_WITH(write_exr("frame.exr", frame), Catch::Contains("another size"));
}
