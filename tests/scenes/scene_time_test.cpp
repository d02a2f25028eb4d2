#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <string>

#include "materials/base/document.hpp"
#include "scenes/job/input/read_time.hpp"

using namespace diurna;

namespace {

TimeInput time_of(const std::string& keys, const std::optional<Site>& site = {}) {
    Document document = Document::from_text("[time]\n" + keys, "scene.toml");
    const TimeInput time = read_time(document.root().required_section("time", ""), site);
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
                      Catch::Contains("cannot be combined with"));
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
    // A window over midnight, of the night on which the span begins and of the next.
    const TimeInput night =
        time_of(start + "duration_h = 26.0\nframes = [\"23:30-00:30 every 30 min\"]");
    CHECK(night.frames.size() == 5);
    CHECK(seconds_between(night.start, night.frames.at(0)) == 1.5 * 3600.0);
    CHECK(seconds_between(night.start, night.frames.at(2)) == 2.5 * 3600.0);
    CHECK_THROWS_WITH(time_of(start + "frames = [\"at dawn\"]"), Catch::Contains("time.frames"));
    // Moments of TOML are as good as texts.
    const TimeInput noon = time_of(start + "frames = [2026-03-08T12:00:00-05:00]");
    CHECK(format_instant(noon.frames.at(0)) == "2026-03-08T17:00:00Z");
    CHECK_THROWS_WITH(time_of(start + "frames = [2026-03-08T12:00:00]"),
                      Catch::Contains("time.frames") && Catch::Contains("T06:00:00-04:00"));
    CHECK_THROWS_WITH(time_of(start + "frames = [\"2026-03-09T03:00:01Z\"]"),
                      Catch::Contains("outside the span"));
    CHECK_THROWS_WITH(time_of(start + "frame_every_s = 60.0\nframes = [\"05:00-06:00 every 1 h\"]"),
                      Catch::Contains("cannot be combined with"));
}

namespace {

std::vector<std::string> frames_of(const std::string& keys) {
    std::vector<std::string> at;
    for (const Instant frame : time_of(keys).frames) at.push_back(format_instant(frame));
    return at;
}

}  // namespace

TEST_CASE("a span includes the leap day, if there is one", "[scenes][time]") {
    const auto hours = [](const std::string& from, const std::string& to) {
        return time_of("start = " + from + "\nend = " + to).duration / 3600.0;
    };
    CHECK(hours("2028-02-28T12:00:00Z", "2028-03-01T12:00:00Z") == 48.0);
    CHECK(hours("2026-02-28T12:00:00Z", "2026-03-01T12:00:00Z") == 24.0);
    CHECK(hours("2100-02-28T12:00:00Z", "2100-03-01T12:00:00Z") == 24.0);
    CHECK(frames_of("start = 2028-02-28T00:00:00+01:00\nduration_h = 72.0\n"
                    "frames = [\"06:00-06:30 every 1 h\"]") ==
          std::vector<std::string>{"2028-02-28T05:00:00Z", "2028-02-29T05:00:00Z",
                                   "2028-03-01T05:00:00Z"});
    CHECK_THROWS_WITH(time_of("start = \"2026-02-29T00:00:00Z\""),
                      Catch::Contains("does not exist"));
}

TEST_CASE("windows are of the scene's clock, whatever day it is in UTC", "[scenes][time]") {
    // 19 h in the east of America is midnight in Greenwich, 9 h in Japan too.
    CHECK(frames_of("start = 2026-12-31T12:00:00-05:00\nduration_h = 24.0\n"
                    "frames = [\"18:30-19:30 every 30 min\"]") ==
          std::vector<std::string>{"2026-12-31T23:30:00Z", "2027-01-01T00:00:00Z",
                                   "2027-01-01T00:30:00Z"});
    CHECK(frames_of("start = 2026-07-15T00:00:00+09:00\nduration_h = 24.0\n"
                    "frames = [\"08:59-09:01 every 1 min\"]") ==
          std::vector<std::string>{"2026-07-14T23:59:00Z", "2026-07-15T00:00:00Z",
                                   "2026-07-15T00:01:00Z"});
    // A whole day has both its midnights.
    CHECK(frames_of("start = 2026-07-15T00:00:00-05:00\nduration_h = 24.0\n"
                    "frames = [\"00:00-24:00 every 12 h\"]") ==
          std::vector<std::string>{"2026-07-15T05:00:00Z", "2026-07-15T17:00:00Z",
                                   "2026-07-16T05:00:00Z"});
    CHECK(time_of("start = 2026-07-15T00:00:00-04:00").utc_offset == -4.0 * 3600.0);
    CHECK(time_of("start = 2026-07-15T00:00:00+05:45").utc_offset == 5.75 * 3600.0);
    CHECK(time_of("start = 2026-07-15T00:00:00Z").utc_offset == 0.0);
}

TEST_CASE("where clocks change, the offset determines the instant", "[scenes][time]") {
    // The hour from 1 to 2 of 1 November 2026 is twice on clocks in America, and two hours long.
    CHECK(frames_of("start = 2026-11-01T00:00:00-04:00\nend = 2026-11-02T00:00:00-05:00\n"
                    "frames = [\"2026-11-01T01:30:00-04:00\", \"2026-11-01T01:30:00-05:00\"]") ==
          std::vector<std::string>{"2026-11-01T05:30:00Z", "2026-11-01T06:30:00Z"});
    CHECK(time_of("start = 2026-11-01T00:00:00-04:00\nend = 2026-11-02T00:00:00-05:00").duration ==
          25.0 * 3600.0);
    CHECK(time_of("start = 2026-03-29T00:00:00+01:00\nend = 2026-03-30T00:00:00+02:00").duration ==
          23.0 * 3600.0);  // Europe, forward
    // Windows stay on the clock of the start.
    CHECK(frames_of("start = 2026-11-01T00:00:00-04:00\nduration_h = 48.0\n"
                    "frames = [\"06:00-06:10 every 1 h\"]") ==
          std::vector<std::string>{"2026-11-01T10:00:00Z", "2026-11-02T10:00:00Z"});
}

TEST_CASE("a state to go on from is a file, and the only start then", "[scenes][time]") {
    CHECK_THROWS_WITH(time_of(start + "spin_up = \"state\""),
                      Catch::Contains("needs a state file"));
    CHECK_THROWS_WITH(time_of(start + "state = \"nowhere.nc\""),
                      Catch::Contains("time.state") && Catch::Contains("no such file"));
    CHECK_THROWS_WITH(time_of(start + "spin_up = \"steady\"\nstate = \"nowhere.nc\""),
                      Catch::Contains("spin_up other than"));
}

TEST_CASE("pictures are taken where the sun stands, day by day", "[scenes][time]") {
    // NREL/TP-560-34302, appendix A.5: transit at 18:46:04.97 UT on 2003-10-17 (equation of time
    // 14.64 min, which grows by a dozen seconds a day then: sun_passages_test.cpp).
    const Site golden{39.742476, -105.1786, std::nan("")};
    const std::string from = "start = 2003-10-16T15:00:00-07:00\nduration_h = 72.0\n";
    const TimeInput noons = time_of(from + "frames_at_sun = { azimuth_deg = 180.0 }", golden);
    REQUIRE(noons.frames.size() == 3);
    CHECK(std::abs(seconds_between(parse_instant("2003-10-17T18:46:05Z"), noons.frames[0])) <= 1.0);
    for (std::size_t i = 1; i < 3; ++i) {
        const double apart = seconds_between(noons.frames[i - 1], noons.frames[i]);
        CHECK(apart == Approx(86400.0 - 12.0).margin(2.0));
    }
    CHECK(noons.frames_note.empty());

    // The sun's declination falls through -9.3 degrees on the 17th (the same appendix: -9.31434 at
    // 19:30 UT) by 0.37 a day: it reaches 90 - 39.74 - 9.1 = 41.16 degrees on the 16th and before.
    const TimeInput high = time_of(
        "start = 2003-10-14T00:00:00-07:00\nduration_h = 120.0\n"
        "frames_at_sun = { elevation_deg = 41.16, half = \"morning\" }",
        golden);
    CHECK(high.frames.size() == 3);
    CHECK_THAT(high.frames_note,
               Catch::Contains("2 of 5 days") && Catch::Contains("2003-10-17 to 2003-10-18"));
    CHECK_THROWS_WITH(time_of(from + "frames_at_sun = { elevation_deg = 80.0 }", golden),
                      Catch::Contains("time.frames_at_sun") && Catch::Contains("4 of 4 days"));
    CHECK_THROWS_WITH(time_of(from + "frames_at_sun = { azimuth_deg = 180.0 }"),
                      Catch::Contains("[site]"));
    CHECK_THROWS_WITH(
        time_of(from + "frame_every_s = 60.0\nframes_at_sun = { azimuth_deg = 180.0 }", golden),
        Catch::Contains("cannot be combined with"));
    CHECK_THROWS_WITH(
        time_of(from + "frames_at_sun = { azimuth_deg = 180.0, half = \"both\" }", golden),
        Catch::Contains("half"));
}
