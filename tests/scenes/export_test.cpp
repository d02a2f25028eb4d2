#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <iterator>
#include <map>
#include <string>

#include "materials/base/files.hpp"
#include "tests/support/independent_reader.hpp"
#include "tests/support/small_scene.hpp"

// What `diurna export` leaves, read by third-party programs.

namespace {

namespace fs = std::filesystem;

Ran diurna(const std::string& arguments) {
    return ran("'" DIURNA_BINARY "' " + arguments + " 2>&1");
}

std::string quoted(const fs::path& path) { return fmt::format("'{}'", path.string()); }

/// Two hours of the small scene, as a run's folder has them.
fs::path two_hours(const ScratchFolder& folder) {
    write_text(folder.path / "scene.toml", small_scene());
    fs::create_directory(folder.path / "run");
    const Ran solved =
        diurna("solve " + quoted(folder.path / "scene.toml") + " --set time.duration_h=2 --out " +
               quoted(folder.path / "run/temperatures.nc"));
    INFO(solved.out);
    REQUIRE((solved.code == 0 || solved.code == 1));  // two hours repeat badly
    return folder.path / "run";
}

}  // namespace

TEST_CASE("others read in exports what temperatures.nc holds", "[scenes][export]") {
    if (!independent_readers()) return;
    const ScratchFolder folder("export");
    const std::string begin = "export " + quoted(two_hours(folder)) + " --to ";
    for (const std::string& arguments :
         {"csv --out " + quoted(folder.path / "curves.csv"),
          "vtu --out " + quoted(folder.path / "day.pvd"),
          "geotiff --out " + quoted(folder.path / "ground.tif") + " --scene " +
              quoted(folder.path / "scene.toml"),
          "kmz --out " + quoted(folder.path / "overlay.kmz") + " --scene " +
              quoted(folder.path / "scene.toml"),
          "ply --out " + quoted(folder.path / "mesh.ply") + " --at 2026-07-15T00:15:00-04:00"}) {
        const Ran made = diurna(begin + arguments);
        CAPTURE(arguments, made.out);
        REQUIRE(made.code == 0);
    }
    const Ran read = read_by("export_reader.py", quoted(folder.path));
    INFO(read.out);
    CHECK(read.code == 0);
}

TEST_CASE("an export replaces neither an input nor a result of its run", "[scenes][export]") {
    const ScratchFolder folder("export_own");
    const std::string from = DIURNA_SOURCE_DIR "/scenes/jacksboro/weather.csv";
    const fs::path weather = folder.path / "weather.csv", run = folder.path / "run";
    fs::copy_file(from, weather);
    write_text(folder.path / "scene.toml", with(small_scene(), from, "weather.csv"));
    // Started in the scene's folder: its manifest has the inputs' names from there.
    const Ran made = ran("cd " + quoted(folder.path) +
                         " && '" DIURNA_BINARY
                         "' run scene.toml --allow-outside --progress none "
                         "--set time.duration_h=2 --out run 2>&1");
    INFO(made.out);
    REQUIRE((made.code == 0 || made.code == 1));
    REQUIRE(fs::exists(run / "manifest.json"));
    for (const fs::path& own : {weather, folder.path / "scene.toml", run / "manifest.json",
                                run / "report.html", run / "temperatures.nc"}) {
        CAPTURE(own);
        const std::string before = diurna::read_text(own);
        for (const char* format : {"csv", "ply --at 2026-07-15T04:10:00Z"}) {
            const Ran refused =
                diurna("export " + quoted(run) + " --to " + format + " --out " + quoted(own));
            CAPTURE(refused.out);
            CHECK(refused.code == 2);
            CHECK(refused.out.find("would be overwritten") != std::string::npos);
        }
        CHECK(diurna::read_text(own) == before);
    }
    CHECK(
        diurna("export " + quoted(run) + " --to csv --out " + quoted(folder.path / "c.csv")).code ==
        0);
}

TEST_CASE("an export that cannot be writes nothing", "[scenes][export]") {
    const ScratchFolder folder("export_refused");
    const fs::path run = two_hours(folder);
    const std::string begin = "export " + quoted(run) + " --out ", x = quoted(folder.path / "x");
    const std::string other = DIURNA_SOURCE_DIR "/scenes/approach/scene.toml";
    for (const auto& [arguments, says] : std::map<std::string, std::string>{
             {x + " --to gif", "gif not in"},
             {x, "--to is required"},
             {x + " --to vtu", "expected FILE.pvd"},
             {x + " --to geotiff", "--scene: is required"},
             {x + " --to geotiff --scene '" + other + "'", "belongs to another scene"},
             {x + " --to kmz", "--scene: is required"},
             {x + " --to csv --scene '" + other + "'", "apply to --to geotiff and kmz only"},
             {x + " --to ply", "expected one"},
             {x + " --to ply --of object:hangar --at 2026-07-15T04:10:00Z",
              "applies to --to csv only"},
             {x + " --to csv --of object:hangr", "did you mean 'object:hangar'?"},
             {x + " --to csv --at yesterday", "--at"},
             {x + " --to csv --at 2026-07-16T04:10:00Z", "has 2026-07-15T04:00:00Z to"},
             {quoted(run / "temperatures.nc") + " --to csv", "would be overwritten"},
             {quoted(folder.path / "no/x") + " --to csv", "the folder does not exist"},
         }) {
        const Ran refused = diurna(begin + arguments);
        CAPTURE(arguments, refused.out);
        CHECK(refused.code == 2);
        CHECK(refused.out.find(says) != std::string::npos);
        CHECK(std::count(refused.out.begin(), refused.out.end(), '\n') == 1);
    }
    CHECK(diurna("export " + quoted(folder.path / "none") + " --to csv --out " + x).code == 2);
    CHECK(diurna("export " + quoted(folder.path) + " --to csv --out " + x).code == 2);
    CHECK_FALSE(fs::exists(folder.path / "x"));
    CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator{}) == 2);
}
