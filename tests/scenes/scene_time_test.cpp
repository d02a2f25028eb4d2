#include <catch2/catch.hpp>
#include <string>

#include "materials/base/document.hpp"
#include "scenes/input/read_time.hpp"

using namespace diurna;

namespace {

TimeInput time_of(const std::string& keys) {
    Document document = Document::from_text("[time]\n" + keys, "scene.toml");
    const TimeInput time = read_time(document.root().required_section("time", ""));
    document.finish();
    return time;
}

const std::string start = "start = 2026-03-07T22:00:00-05:00\n";

}  // namespace

TEST_CASE("a span may be minutes or months, by its end or its duration", "[scenes][time]") {
    CHECK(time_of(start).duration == 86400.0);
    CHECK(time_of(start + "duration_h = 0.1").duration == Approx(360.0));
    CHECK(time_of(start + "end = 2026-05-07T22:00:00-04:00").duration ==
          61.0 * 86400.0 - 3600.0);  // clocks went forward: the offset counts, not the wall
    CHECK_THROWS_WITH(time_of(start + "end = 2026-03-07T22:00:00-05:00"),
                      Catch::Contains("time.end") && Catch::Contains("0 h after start"));
    CHECK_THROWS_WITH(time_of(start + "duration_h = 2.0\nend = 2026-03-08T22:00:00-05:00"),
                      Catch::Contains("one of the two"));
}

TEST_CASE("pictures are taken every so often, at instants and in windows", "[scenes][time]") {
    const TimeInput even = time_of(start + "duration_h = 2.0\nframe_every_s = 1000.0");
    REQUIRE(even.frames.size() == 8);  // 0 to 7000 s of 7200
    CHECK(seconds_between(even.start, even.frames.back()) == 7000.0);

    // Two days from 22 h on: the windows of the 8th and the 9th, on the clock of the start.
    const TimeInput dawn = time_of(start +
                                   "duration_h = 48.0\n"
                                   "frames = [\"05:00-06:00 every 20 min\", "
                                   "\"2026-03-08T03:07:00Z\"]");
    std::vector<std::string> at;
    for (const Instant frame : dawn.frames) at.push_back(format_instant(frame));
    CHECK(at == std::vector<std::string>{
                    "2026-03-08T03:07:00Z", "2026-03-08T10:00:00Z", "2026-03-08T10:20:00Z",
                    "2026-03-08T10:40:00Z", "2026-03-08T11:00:00Z", "2026-03-09T10:00:00Z",
                    "2026-03-09T10:20:00Z", "2026-03-09T10:40:00Z", "2026-03-09T11:00:00Z"});
    CHECK_THROWS_WITH(time_of(start + "frames = [\"at dawn\"]"), Catch::Contains("time.frames"));
    CHECK_THROWS_WITH(time_of(start + "frames = [\"2026-03-09T03:00:01Z\"]"),
                      Catch::Contains("outside the span"));
    CHECK_THROWS_WITH(time_of(start + "frame_every_s = 60.0\nframes = [\"05:00-06:00 every 1 h\"]"),
                      Catch::Contains("one of the two"));
}
