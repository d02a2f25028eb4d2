#include "scenes/job/plan/chosen_pictures.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/job.hpp"
#include "scenes/job/run/listed_outputs.hpp"
#include "tests/support/differing.hpp"
#include "tests/support/folder_contents.hpp"
#include "tests/support/ran.hpp"
#include "tests/support/small_scene.hpp"

// A part of a scene's pictures: the right ones, and each to the byte what it is among all.

using namespace diurna;

namespace {

namespace fs = std::filesystem;

const PrivateTempFolder temp;

/// Two observers, one at six hours of a day, one at noon and at one.
std::string two_observers() {
    std::string text = with(small_scene(), "radius_m = 4000.0", "radius_m = 2500.0");
    text = with(text, "sky_rays = 32", "sky_rays = 16");
    text = with(text, "step_s = 1200.0", "step_s = 3600.0");
    text = with(text, "frame_every_s = 21600.0", "frame_every_s = 14400.0");
    return text + R"([[observer]]
name = "above"
place_m = [100.0, 100.0]
height_above_ground_m = 900.0
look_at_m = [0.0, 0.0]
width = 32
height = 24
bands = ["8-12"]
frames = ["2026-07-15T12:00:00-04:00", "2026-07-15T13:00:00-04:00"]
)";
}

/// "east 8-12 T0400" for every picture, hours in UTC.
std::vector<std::string> reported(const std::vector<ObserverInput>& observers) {
    std::vector<std::string> pictures;
    for (const ObserverInput& observer : observers) {
        for (const Instant when : observer.frames) {
            for (const std::string& band : observer.bands)
                pictures.push_back(observer.name + " " + band + " " +
                                   format_instant(when).substr(11, 5));
        }
    }
    return pictures;
}

using Texts = std::vector<std::string>;

std::string refused(const Scene& scene, const PictureChoice& choice) {
    try {
        chosen_pictures(scene, choice);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// Labels of pictures, the pictures, temperatures: what does not tell of the run itself.
std::map<std::string, std::string> results(const fs::path& folder) {
    auto found = contents(folder);
    for (const char* name : {"report.html", "manifest.json", "ledger.jsonl"}) found.erase(name);
    return found;
}

}  // namespace

TEST_CASE("pictures are chosen by observer, band and hour of the scene's clock", "[only]") {
    const ScratchFolder folder("only");
    write_text(folder.path / "scene.toml", two_observers());
    const Scene scene = read_scene(folder.path / "scene.toml", {}, true);
    const auto chosen = [&](Texts only) {
        return reported(chosen_pictures(scene, {.only = only}));
    };
    // Clocks are four hours behind UTC: midnight is 04:00.
    CHECK(reported(scene.observers).size() == 14);
    CHECK(chosen({"observer=above"}) == Texts{"above 8-12 16:00", "above 8-12 17:00"});
    CHECK(chosen({"frames=07:59..12:00", "band=8-12"}) ==
          Texts{"east 8-12 12:00", "east 8-12 16:00", "above 8-12 16:00"});
    CHECK(chosen({"frames=20:00..04:00", "observer=east", "band=3-5"}) ==
          Texts{"east 3-5 04:00", "east 3-5 08:00", "east 3-5 00:00"});
    CHECK(chosen({"frames=2026-07-15T17:00:00Z"}) == Texts{"above 8-12 17:00"});
    CHECK(chosen({"frames=2026-07-15T16:00:00-04:00..2026-07-16T04:00:00Z", "band=3-5"}) ==
          Texts{"east 3-5 20:00", "east 3-5 00:00"});
    CHECK(chosen({"frames=13:00", "frames=16:00", "band=8-12"}) ==
          Texts{"east 8-12 20:00", "above 8-12 17:00"});

    for (const auto& [only, expected] : std::vector<std::pair<std::string, std::string>>{
             {"observer=eest", "did you mean 'east'"},
             {"band=8-13", "did you mean '8-12'"},
             {"frames=5", "expected hours of the day"},
             {"frames=05:60", "expected hours of the day"},
             {"frames=03:00", "no picture"},
             {"hours=03:00", "expected one of observer"},
             {"", "expected one of observer"}}) {
        CAPTURE(only);
        CHECK(refused(scene, {.only = {only}}).find(expected) != std::string::npos);
    }
}

TEST_CASE("shards have every picture once", "[only]") {
    const ScratchFolder folder("shards");
    write_text(folder.path / "scene.toml", two_observers());
    const Scene scene = read_scene(folder.path / "scene.toml", {}, true);
    for (const std::size_t count : {1u, 2u, 3u, 8u, 20u}) {
        Texts all;
        for (std::size_t number = 1; number <= count; ++number) {
            for (std::string& picture :
                 reported(chosen_pictures(scene, {.shard = {number, count}})))
                all.push_back(std::move(picture));
        }
        CHECK(all == reported(scene.observers));
    }
}

TEST_CASE("pictures that depend on others are not parted from them", "[only]") {
    const ScratchFolder folder("remember");
    write_text(folder.path / "scene.toml", two_observers());
    Scene scene = read_scene(folder.path / "scene.toml", {}, true);
    // Three pictures 20 ms apart, an hour later three more; 10 ms of a bolometer remember 10 s.
    const Instant begin = scene.time.start;
    ObserverInput& east = scene.observers[0];
    east.frames = {begin,
                   later(begin, 0.02),
                   later(begin, 0.04),
                   later(begin, 3600.0),
                   later(begin, 3600.02),
                   later(begin, 3600.04)};
    east.instruments = {"8-12"};
    InstrumentInput bolometer;
    bolometer.observer = "east";
    bolometer.band = "8-12";
    bolometer.instrument.detector.time_constant = 0.01;
    scene.instruments.push_back(bolometer);
    CHECK(chosen_pictures(scene, {.only = {"frames=01:00..02:00"}})[0].frames.size() == 3);
    CHECK(refused(scene, {.only = {"frames=2026-07-15T04:00:00.02Z"}})
              .find("depends on its picture") != std::string::npos);
    std::vector<std::size_t> sizes;
    for (std::size_t number = 1; number <= 4; ++number)
        sizes.push_back(chosen_pictures(scene, {.shard = {number, 4}})[0].frames.size());
    CHECK(sizes == std::vector<std::size_t>{3, 3, 0, 0});  // and two of the other observer
    // Of the other band nothing is remembered.
    CHECK(refused(scene, {.only = {"frames=2026-07-15T04:00:00.02Z", "band=3-5"}}).empty());

    east.adaptive = AdaptiveOptions{};
    CHECK(refused(scene, {.only = {"band=3-5"}}).find("all of its bands") != std::string::npos);
}

TEST_CASE("parts of a run joined are the run", "[only]") {
    const ScratchFolder folder("parts");
    const fs::path scene = folder.path / "scene.toml";
    write_text(scene, two_observers());
    const auto run = [&](const std::string& out, PictureChoice pictures, bool resume = false) {
        return run_job(
            read_scene(scene, {}, true),
            {.out = folder.path / out, .pictures = std::move(pictures), .resume = resume});
    };
    run("whole", {});
    const auto whole = results(folder.path / "whole");
    std::vector<fs::path> parts;
    for (std::size_t number = 1; number <= 3; ++number) {
        const std::string name = "part" + std::to_string(number);
        run(name, {.shard = {number, 3}});
        CHECK(verify(folder.path / name).empty());
        for (const auto& [file, text] : results(folder.path / name)) {
            if (file.find("2026") == std::string::npos) continue;  // lists are of fewer pictures
            INFO(file);
            CHECK((whole.contains(file) && whole.at(file) == text));
        }
        parts.push_back(folder.path / name);
    }
    const auto merge = [&](const std::vector<fs::path>& of, const std::string& out) {
        std::string command = "'" DIURNA_BINARY "' merge '" + scene.string() + "'";
        for (const fs::path& part : of) command += " '" + part.string() + "'";
        return ran(command + " --out '" + (folder.path / out).string() +
                   "' --allow-outside --progress none 2>&1");
    };
    CHECK(merge(parts, "joined").code == 0);
    CHECK(differing(results(folder.path / "joined"), whole).empty());
    CHECK(verify(folder.path / "joined").empty());

    const Ran fewer = merge({parts[0], parts[2]}, "fewer");
    CHECK(fewer.code == 2);
    CHECK(fewer.out.find("are in none of the folders") != std::string::npos);
    write_text(parts[1] / "temperatures.nc", "x");
    const Ran spoilt = merge(parts, "spoilt");
    CHECK(spoilt.code == 2);
    CHECK(spoilt.out.find("temperatures.nc") != std::string::npos);
    write_text(scene, with(two_observers(), "\"grass\"", "\"sand\""));
    const Ran other = merge(parts, "other");
    CHECK(other.code == 2);
    CHECK(other.out.find("belongs to another scene") != std::string::npos);
    for (const char* name : {"fewer", "spoilt", "other"})
        CHECK_FALSE(fs::exists(folder.path / name));
    write_text(scene, two_observers());

    // Some first, then the rest.
    const JobReport some =
        run("grown", {.only = {"observer=east", "band=3-5", "frames=00:00..9:00"}});
    CHECK(some.frames_rendered == 3);
    CHECK(verify(folder.path / "grown").empty());
    CHECK_FALSE(fs::exists(folder.path / "grown/frames/east_8-12_20260715T040000Z.exr"));
    run("grown", {}, true);
    CHECK(differing(results(folder.path / "grown"), whole).empty());
}
