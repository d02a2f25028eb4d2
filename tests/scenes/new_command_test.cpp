#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "materials/base/files.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

// A first scene of a place: it must be one that runs, whatever was given.

namespace {

namespace fs = std::filesystem;

int verb(const std::string& arguments, const fs::path& reported) {
    return WEXITSTATUS(std::system(
        ("'" DIURNA_BINARY "' " + arguments + " >'" + reported.string() + "' 2>&1").c_str()));
}

const std::string elevation = DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif";

}  // namespace

TEST_CASE("a first scene of an elevation file alone is one that solves", "[scenes][new]") {
    const ScratchFolder folder("new");
    const fs::path scene = folder.path / "place", reported = folder.path / "told.txt";
    REQUIRE(verb("new '" + scene.string() + "' --dem '" + elevation + "'", reported) == 0);
    CHECK(read_text(reported).find("the weather is generated") != std::string::npos);
    CHECK(fs::exists(scene / "elevation.tif"));
    CHECK(read_text(scene / "scene.toml").find("not measured") != std::string::npos);
    // Noon of its clock is within half an hour of the sun's.
    const Scene read = read_scene(scene / "scene.toml");
    CHECK(std::abs(read.time.utc_offset / 3600.0 - read.site->longitude_deg / 15.0) <= 0.5);
    CHECK(read.observers.size() == 1);
    CHECK(verb("check '" + (scene / "scene.toml").string() + "'", reported) == 0);
    CHECK(verb("solve '" + (scene / "scene.toml").string() + "' --set time.duration_h=2 " +
                   "--set terrain.radius_m=200 --out '" + (folder.path / "t.nc").string() + "'",
               reported) == 0);
}

TEST_CASE("a first scene takes the first whole day of its weather", "[scenes][new]") {
    const ScratchFolder folder("new_weather");
    const fs::path reported = folder.path / "told.txt";
    std::string weather = "time,air_temperature_K\n";
    for (int h = 5; h < 60; ++h) {
        weather +=
            fmt::format("2024-03-{:02}T{:02}:00:00Z,{}\n", 10 + h / 24, h % 24, 280 + h % 24);
    }
    write_text(folder.path / "measured.csv", weather);
    const std::string begin = "new '" + (folder.path / "place").string() + "' --dem '" + elevation +
                              "' --weather '" + (folder.path / "measured.csv").string() + "'";
    REQUIRE(verb(begin + " --at 36.30,-84.25", reported) == 0);
    const Scene scene = read_scene(folder.path / "place/scene.toml");
    // 84.25 W is UTC - 6 h: midnight of the 10th is 06 Z, an hour after the first row.
    CHECK(scene.time.start == parse_instant("2024-03-10T00:00:00-06:00"));
    CHECK(scene.time.duration == 86400.0);
    CHECK(scene.site->latitude_deg == Approx(36.30));
}

TEST_CASE("a first scene declares the columns of a foreign weather file", "[scenes][new]") {
    const ScratchFolder folder("new_foreign");
    const fs::path reported = folder.path / "told.txt", file = folder.path / "station.csv";
    std::string weather = "Date Time (UTC);Temp (°C);RH (%);Battery (V)\n";
    for (int h = 0; h < 72; ++h) {
        weather += fmt::format("2024-03-{:02} {:02}:00;{},5;{};12,1\n", 10 + h / 24, h % 24, h % 24,
                               40 + h % 24);
    }
    write_text(file, weather);
    const std::string begin = "new '" + (folder.path / "place").string() + "' --dem '" + elevation +
                              "' --at 36.30,-84.25 --weather '";
    REQUIRE(verb(begin + file.string() + "'", reported) == 0);
    CAPTURE(read_text(reported));
    CHECK(read_text(reported).find("'Temp (°C)' = \"air_temperature degC\"") != std::string::npos);
    const std::string scene = read_text(folder.path / "place/scene.toml");
    CHECK(scene.find("'Date Time (UTC)' = \"time UTC\"") != std::string::npos);
    CHECK(verb("check '" + (folder.path / "place/scene.toml").string() + "'", reported) == 0);
    CHECK(verb("inspect '" + file.string() + "'", reported) == 0);
    CHECK(read_text(reported).find("relative_humidity %") != std::string::npos);
    // A unit that nobody knows: one line, nothing written.
    fs::remove_all(folder.path / "place");
    write_text(file, "stamp;Temp;RH\n2024-03-10T00:00Z;3;50\n");
    CHECK(verb(begin + file.string() + "'", reported) == 2);
    const std::string line = read_text(reported);
    CAPTURE(line);
    CHECK(std::count(line.begin(), line.end(), '\n') == 1);
    CHECK(line.find("found the columns 'stamp', 'Temp', 'RH'") != std::string::npos);
    CHECK(line.find("Temp = \"air_temperature UNIT\"") != std::string::npos);
    CHECK(!fs::exists(folder.path / "place"));
}

TEST_CASE("a first scene takes the day of a year's file nearest to its date", "[scenes][new]") {
    // EPW of June 2018 alone, one year: not typical, so it has no weather of 2026. The usual date
    // is 15 July north of the equator; the 30th of June is the nearest whole day of UTC - 6 h that
    // ends within the file, which is in UTC - 5 h.
    const ScratchFolder folder("new_epw");
    const fs::path reported = folder.path / "told.txt";
    std::string epw =
        "LOCATION,Place,-,-,-,0,36.3,-84.2,-5.0,400.0\nDESIGN CONDITIONS,0\n"
        "TYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\n"
        "COMMENTS 1,\nCOMMENTS 2,\nDATA PERIODS,1,1,Data,Friday, 6/ 1,DAY\n";
    const auto begin = [&](const std::string& name, int july_days) {
        std::string text = epw;
        text.replace(text.find("DAY"), 3, july_days == 0 ? "6/30" : "7/31");
        for (int day = 1; day <= 30 + july_days; ++day) {
            for (int hour = 1; hour <= 24; ++hour) {
                text += fmt::format(
                    "2018,{},{},{},0,x,{},5,50,98000,0,0,300,0,0,0,9,9,9,9,180,2.0\n",
                    day <= 30 ? 6 : 7, day <= 30 ? day : day - 30, hour, 10 + hour % 12);
            }
        }
        write_text(folder.path / (name + ".epw"), text);
        return "new '" + (folder.path / name).string() + "' --dem '" + elevation + "' --weather '" +
               (folder.path / (name + ".epw")).string() + "'";
    };
    REQUIRE(verb(begin("june", 0), reported) == 0);
    CHECK(read_text(reported).find("note: ") != std::string::npos);
    CHECK(read_text(reported).find("nearest to 2026-07-15") != std::string::npos);
    const Instant june = read_scene(folder.path / "june/scene.toml").time.start;
    CHECK(june >= parse_instant("2018-06-29T00:00:00-06:00"));
    CHECK(june <= parse_instant("2018-06-30T00:00:00-06:00"));
    REQUIRE(verb(begin("july", 31), reported) == 0);
    CHECK(read_scene(folder.path / "july/scene.toml").time.start ==
          parse_instant("2018-07-15T00:00:00-06:00"));
}

TEST_CASE("a first scene that cannot be leaves nothing", "[scenes][new]") {
    const ScratchFolder folder("new_refused");
    const fs::path scene = folder.path / "place", reported = folder.path / "told.txt";
    const std::string begin = "new '" + scene.string() + "' --dem ";
    for (const auto& [arguments, says] :
         {std::pair{fmt::format("'{}/none.tif'", folder.path.string()), std::string("none.tif")},
          {"'" + elevation + "' --at 36.3", std::string("latitude and longitude in degrees")},
          {"'" + elevation + "' --at 10.0,20.0",
           std::string("does not contain 10.00000 N, 20.00000 E")},
          {"'" + elevation + "' --weather '" + elevation + "'", std::string("elevation.tif")}}) {
        CHECK(verb(begin + arguments, reported) == 2);
        INFO(read_text(reported));
        CHECK(read_text(reported).find(says) != std::string::npos);
        CHECK(!fs::exists(scene));
    }
    // Columns of other names are described in a scene, which there is not yet.
    const fs::path logger = folder.path / "logger.csv";
    write_text(logger, "time,T_air\n2026-07-15T00:00:00Z,20\n2026-07-16T00:00:00Z,22\n");
    CHECK(verb(begin + "'" + elevation + "' --weather '" + logger.string() + "'", reported) == 2);
    CHECK(read_text(reported).find("run `new` without --weather, then set weather.file and "
                                   "[weather.columns] in scene.toml, or rename the columns") !=
          std::string::npos);
    CHECK(!fs::exists(scene));
    fs::create_directory(scene);
    CHECK(verb(begin + "'" + elevation + "'", reported) == 2);
    CHECK(fs::is_empty(scene));
}
