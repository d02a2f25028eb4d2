#pragma once

#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/crate.hpp"
#include "tests/support/ran.hpp"
#include "tests/support/small_scene.hpp"

/// A scene that somebody has sent, in a folder of its own, and what is not its business beside it:
/// what SECURITY.md promises is seen from outside, exit code, lines and files.
namespace confined {

namespace fs = std::filesystem;

inline const std::string secret = "XYZZY7f3a";  // in files outside
inline const std::string beyond = "is outside the folder of the file that names it";

/// 124: it took over 30 s.
inline Ran run_diurna(const std::string& arguments, const std::string& first = "") {
    const std::string command =
        first + "timeout 30 '" DIURNA_BINARY "' " + arguments + " 2>&1 </dev/null";
    return ran(command);
}

inline std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        names.push_back(entry.path().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// A folder with a scene of its own, `yard`, and one beside it that is not the scene's, `outside`.
struct Place {
    ScratchFolder folder{"confines"};
    fs::path yard = folder.path / "yard", outside = folder.path / "outside";

    Place() {
        fs::create_directories(yard / "inner");
        fs::create_directories(outside);
        for (const char* file : {"level.asc", "level.prj"}) {
            fs::copy_file(fs::path(DIURNA_SOURCE_DIR "/scenes/crossover") / file, yard / file);
        }
        fs::copy_file(DIURNA_SOURCE_DIR "/scenes/jacksboro/weather.csv", yard / "weather.csv");
        write_text(yard / "crate.obj", crate_mesh);
    }
    /// The scene with more lines: of the root's tables, and of some tables that it has.
    struct More {
        std::string elevation = "level.asc", weather = "weather.csv", mesh = "crate.obj";
        std::string tables{}, terrain{}, time{}, atmosphere{}, object{};
    };
    void write(const More& more) const { write_text(yard / "scene.toml", text(more)); }
    static std::string text(const More& more) {
        return R"([scene]
sky_rays = 16
object_sky_rays = 16
[site]
latitude_deg = 36.32
longitude_deg = -84.203333
[terrain]
elevation = ")" +
               more.elevation + "\"\nmaterial = \"grass\"\nradius_m = 150.0\n" + more.terrain +
               "[atmosphere]\n" + more.atmosphere + "[weather]\nfile = \"" + more.weather +
               R"("
interval = "instant"
[time]
start = 2026-07-15T00:00:00-04:00
duration_h = 1.0
frames = ["2026-07-15T00:30:00-04:00"]
)" + more.time +
               R"([[observer]]
name = "east"
place_m = [60.0, 0.0]
height_above_ground_m = 20.0
look_at_m = [0.0, 0.0]
width = 8
height = 6
samples = 1
bands = ["8-12"]
[[object]]
name = "crate"
mesh = ")" + more.mesh +
               "\"\nup = \"z\"\nmaterial = \"concrete\"\n" +
               (more.object.find("copies_file") == 0 ? "" : "place_m = [0.0, 0.0]\n") +
               more.object + more.tables;
    }
    Ran ran(const std::string& more = "") const {
        return run_diurna("solve '" + (yard / "scene.toml").string() + "' --progress none --out '" +
                          (yard / "t.nc").string() + "' " + more);
    }
    /// Refused in one line that says so, and nothing else has happened.
    Ran refused(const std::string& says) const {
        const std::vector<std::string> before = names_in(folder.path);
        const Ran result = ran();
        CAPTURE(result.out);
        CHECK(result.code == 2);
        CHECK(std::count(result.out.begin(), result.out.end(), '\n') == 1);
        CHECK_THAT(result.out, Catch::Contains(says));
        CHECK_THAT(result.out, !Catch::Contains(secret));
        CHECK(names_in(folder.path) == before);
        return result;
    }
};

using More = Place::More;

}  // namespace confined
