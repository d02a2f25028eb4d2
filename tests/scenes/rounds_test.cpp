#include "scenes/job/run/rounds.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// The hangar from near by, by few rays: its surface check finds 0.07 K (95 % interval 0.05 to
/// 0.10).
std::string near_hangar() {
    return "tolerance_K = 0.03\n" +
           with(with(with(small_scene(), "sky_rays = 32", "sky_rays = 16\nobject_sky_rays = 16"),
                     "radius_m = 4000.0", "radius_m = 1000.0"),
                "place_m = [2000.0, 1100.0]\nheight_above_ground_m = 450.0\nlook_at_m = [0.0, 0.0]",
                "place_m = [153.0, 1.6]\nheight_above_ground_m = 20.0\nlook_at_m = [53.0, -88.4]");
}

std::string whole_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

JobReport run(const ScratchFolder& folder, const std::string& out,
              const std::vector<std::string>& settings, bool resume = false) {
    const auto file = folder.path / "scene.toml";
    return run_job(read_scene(file, settings), {.out = folder.path / out,
                                                .settings = settings,
                                                .resume = resume,
                                                .scene_with = reads_scene(file, settings, false)});
}

std::size_t rounds_of(const JobReport& report) {
    return std::size_t(
        std::count_if(report.notes.begin(), report.notes.end(),
                      [](const std::string& note) { return note.starts_with("round "); }));
}

}  // namespace

TEST_CASE("a round divides edges by at most two, and only where the check misses its tolerance",
          "[scenes][rounds]") {
    Scene scene;
    scene.tolerance = 0.1;
    scene.finer_edges = 1.5;
    CheckError error;
    error.rms = 0.4;
    error.low = 0.3;
    error.set = {{"scene.finer_edges", 12.0, "size of facets", 0.8},
                 {"scene.sky_rays", 256.0, "rays of the ground", 0.2}};
    const Round round = round_after(error, scene);
    CHECK(round.settings == std::vector<std::string>{"scene.finer_edges=3", "scene.sky_rays=256"});
    error.low = 0.09;
    CHECK(round_after(error, scene).settings.empty());
    error.low = 0.3;
    scene.tolerance = 0.0;
    CHECK(round_after(error, scene).settings.empty());
}

TEST_CASE("a round's setting replaces that of the same key", "[scenes][rounds]") {
    CHECK(after_rounds({"a.b=1", "a.c=2"}, {{"", {"a.b=3"}}, {"", {"a.d=4", "a.b=5"}}}) ==
          std::vector<std::string>{"a.c=2", "a.d=4", "a.b=5"});
}

// The pictures of a run with rounds are those of a run that is given their settings, byte for byte.
TEST_CASE("a run above its tolerance solves again with finer settings", "[scenes][rounds]") {
    const ScratchFolder folder("rounds");
    write_text(folder.path / "scene.toml", near_hangar());
    const JobReport none = run(folder, "none", {"rounds=0"});
    CHECK(rounds_of(none) == 0);
    const JobReport some = run(folder, "some", {"rounds=1"});
    REQUIRE(rounds_of(some) == 1);
    const auto manifest = nlohmann::json::parse(whole_file(folder.path / "some" / "manifest.json"));
    REQUIRE(manifest.at("rounds").size() == 1);
    std::vector<std::string> settings = manifest.at("settings");
    CHECK(settings == after_rounds({"rounds=1"}, {{"", manifest["rounds"][0]["settings"]}}));
    settings.front() = "rounds=0";
    run(folder, "given", settings);
    std::size_t pictures = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder.path / "some" / "frames")) {
        const auto other = folder.path / "given" / "frames" / entry.path().filename();
        CHECK(whole_file(entry.path()) == whole_file(other));
        ++pictures;
    }
    CHECK(pictures > 0);
    CHECK(whole_file(folder.path / "some" / "temperatures.nc") !=
          whole_file(folder.path / "none" / "temperatures.nc"));

    std::filesystem::remove(folder.path / "some" / "report.html");
    const JobReport again = run(folder, "some", {"rounds=1"}, true);
    CHECK(again.frames_rendered == 0);
    CHECK_FALSE(again.solved);
    CHECK(rounds_of(again) == 1);
}
