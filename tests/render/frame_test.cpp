#include "render/picture/frame.hpp"

#include <catch2/catch.hpp>

#include "materials/base/error.hpp"

using namespace diurna;

namespace {

Frame small_frame() {
    Frame frame;
    frame.width = 2;
    frame.height = 1;
    frame.observer = "hill top/1";
    frame.instant = parse_instant("2026-07-01T05:00:00Z");
    for (const char* name : {"radiance.3-5", "apparent_temperature.3-5", "radiance.3-5.5",
                             "radiance.8-12", "temperature", "normal.X"}) {
        frame.planes.push_back({name, "K", {1.0f, 2.0f}});
    }
    return frame;
}

std::vector<std::string> names(const Frame& frame) {
    std::vector<std::string> all;
    for (const Plane& plane : frame.planes) all.push_back(plane.name);
    return all;
}

}  // namespace

TEST_CASE("a plane is found by name, a misspelt one by its neighbour", "[render][frame]") {
    const Frame frame = small_frame();
    CHECK(frame["temperature"].pixel[1] == 2.0f);
    CHECK(frame.find("humidity") == nullptr);
    CHECK_THROWS_WITH(frame["temprature"], Catch::Contains("temperature"));
}

TEST_CASE("the planes of one band are those and, on request, the truth", "[render][frame]") {
    const Frame frame = small_frame();
    CHECK(names(band_frame(frame, "3-5")) == std::vector<std::string>{"radiance.3-5",
                                                                      "apparent_temperature.3-5",
                                                                      "temperature", "normal.X"});
    CHECK(names(band_frame(frame, "3-5.5", false)) == std::vector<std::string>{"radiance.3-5.5"});
    CHECK(band_frame(frame, "8-12").instant == frame.instant);
}

TEST_CASE("a frame's name is fit for a file", "[render][frame]") {
    CHECK(frame_name(small_frame(), "3-5") == "hill-top-1_3-5_20260701T050000Z");
}
