#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/confined_place.hpp"

// A scene is data: whoever sends one chooses what is read, but not beyond its folder. The expected
// results are those promised by SECURITY.md, seen from outside: exit code 2, one line, nothing
// written, nothing printed of what was named.

using namespace confined;

namespace {

const PrivateTempFolder temp;

/// One key of a scene file that names a file.
struct NamingKey {
    std::string key, suffix;
    Place::More (*more)(const std::string& name);
};

const std::vector<NamingKey> naming_keys = {
    {"terrain.elevation", ".asc", [](const std::string& n) { return More{.elevation = n}; }},
    {"weather.file", ".csv", [](const std::string& n) { return More{.weather = n}; }},
    {"object.mesh", ".obj", [](const std::string& n) { return More{.mesh = n}; }},
    {"object.part_file", ".toml",
     [](const std::string& n) { return More{.object = "part_file = \"" + n + "\"\n"}; }},
    {"object.copies_file", ".csv",
     [](const std::string& n) {
         More more{.object = "copies_file = \"" + n + "\"\n"};
         return more;
     }},
    {"terrain.more_tiles", ".asc",
     [](const std::string& n) { return More{.terrain = "more_tiles = [\"" + n + "\"]\n"}; }},
    {"terrain.land_cover.file", ".asc",
     [](const std::string& n) {
         return More{.tables = "[terrain.land_cover]\nfile = \"" + n +
                               "\"\nmaterial = { 1 = \"concrete\" }\n"};
     }},
    {"shapes.file", ".geojson",
     [](const std::string& n) {
         return More{.tables = "[[shapes]]\nfile = \"" + n + "\"\nmaterial = \"concrete\"\n"};
     }},
    {"texture.file", ".asc",
     [](const std::string& n) {
         return More{.tables = "[[texture]]\nname = \"spots\"\nmetres_per_texel = 1.0\nfile = \"" +
                               n + "\"\n"};
     }},
    {"atmosphere.table", ".tp7",
     [](const std::string& n) { return More{.atmosphere = "table = \"" + n + "\"\n"}; }},
    {"atmosphere.sounding", ".csv",
     [](const std::string& n) { return More{.atmosphere = "sounding = \"" + n + "\"\n"}; }},
    {"trajectory.file", ".csv",
     [](const std::string& n) {
         return More{.tables = "[[trajectory]]\nname = \"way\"\nfile = \"" + n +
                               "\"\nstart = 2026-07-15T00:00:00-04:00\n"};
     }},
    {"time.state", ".nc",
     [](const std::string& n) { return More{.time = "state = \"" + n + "\"\n"}; }},
    {"material.own.reflectance", ".csv",
     [](const std::string& n) {
         return More{.tables =
                         "[material.own]\nlike = \"concrete\"\nreflectance = \"" + n + "\"\n"};
     }},
    {"material.own.transmittance", ".csv",
     [](const std::string& n) {
         return More{.tables =
                         "[material.own]\nlike = \"concrete\"\ntransmittance = \"" + n + "\"\n"};
     }},
    {"material.own.finish.index_file", ".csv",
     [](const std::string& n) {
         return More{.tables =
                         "[material.own]\nlike = \"concrete\"\nfinish = { kind = \"gloss\", "
                         "roughness = 0.1, index_file = \"" +
                         n + "\" }\n"};
     }},
    {"material.own.finish.file", ".csv",
     [](const std::string& n) {
         return More{.tables =
                         "[material.own]\nlike = \"concrete\"\nfinish = { kind = \"measured\", "
                         "file = \"" +
                         n + "\" }\n"};
     }},
    {"bands.response", ".csv",
     [](const std::string& n) {
         return More{.tables = "[[bands]]\nname = \"mine\"\nresponse = \"" + n + "\"\n"};
     }},
    {"plume.absorption", ".csv",
     [](const std::string& n) {
         return More{.tables =
                         "[[plume]]\nname = \"smoke\"\nplace_m = [5.0, 5.0]\nheight_m = 3.0\n"
                         "radius_m = 1.0\ntemperature_K = 300.0\nabsorption = \"" +
                         n + "\"\n"};
     }},
};

}  // namespace

TEST_CASE("no key of a scene reads a file beyond its folder", "[confinement]") {
    const Place place;
    const fs::path target = place.outside / "target";
    write_text(target, secret + "\n");
    const std::vector<std::string> elsewhere = {target.string(),
                                                "../outside/target",
                                                "inner/../../outside/target",
                                                "../outside/none",
                                                "/etc/passwd",
                                                "/proc/self/fd/0",
                                                "/dev/zero",
                                                "/dev/stdin",
                                                "/vsizip/" + target.string() + "/a",
                                                "/vsicurl/http://127.0.0.1:9/a.tif"};
    for (std::size_t k = 0; k < naming_keys.size(); ++k) {
        const NamingKey& naming = naming_keys[k];
        CAPTURE(naming.key);
        const fs::path link = place.yard / ("link" + naming.suffix);
        fs::create_symlink(target, link);
        // A link, a name that goes up, and in turn one of the others.
        for (const std::string& name : {link.filename().string(), std::string("../outside/target"),
                                        elsewhere[k % elsewhere.size()]}) {
            CAPTURE(name);
            place.write(naming.more(name));
            const Ran ran = place.refused(beyond);
            CHECK_THAT(ran.out, Catch::Contains(": " + naming.key + ": "));
        }
        fs::remove(link);
    }
    for (const std::string& name : elsewhere) {
        CAPTURE(name);
        place.write({.weather = name});
        place.refused(beyond);
    }
}

TEST_CASE("no key of a scene waits for a pipe, opens a device or a folder", "[confinement]") {
    const Place place;
    const fs::path pipe = place.yard / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    for (const NamingKey& naming : naming_keys) {
        CAPTURE(naming.key);
        const fs::path named = place.yard / ("pipe" + naming.suffix);
        fs::create_symlink(pipe, named);
        for (const std::string& name : {named.filename().string(), std::string("inner")}) {
            CAPTURE(name);
            place.write(naming.more(name));
            place.refused("is not a regular file");
        }
        fs::remove(named);
    }
    // The user who lifts the confines still gets no device.
    place.write({.weather = "/dev/zero"});
    const Ran ran = place.ran("--allow-outside");
    CHECK(ran.code == 2);
    CHECK_THAT(ran.out, Catch::Contains("is not a regular file"));
}

TEST_CASE("links that stay inside are followed, and with --allow-outside those that do not",
          "[confinement]") {
    const Place place;
    fs::rename(place.yard / "weather.csv", place.outside / "weather.csv");
    place.write({.weather = "../outside/weather.csv"});
    CHECK(place.ran("--allow-outside").code == 0);
    CHECK(fs::exists(place.yard / "t.nc"));
    fs::remove(place.yard / "t.nc");
    place.refused(beyond);
    place.write({});
    CHECK(place.ran("--allow-outside --set weather.file=../outside/weather.csv").code == 0);
    CHECK(place.ran("--set weather.file=../outside/weather.csv").code == 2);
    fs::rename(place.outside / "weather.csv", place.yard / "inner/july.csv");
    fs::create_symlink("inner/july.csv", place.yard / "weather.csv");
    CHECK(place.ran().code == 0);
    // The program's own data may be named from anywhere, by a link to the scene's folder too.
    place.write({.weather = DIURNA_SOURCE_DIR "/scenes/jacksboro/weather.csv"});
    CHECK(place.ran().code == 0);
    place.write({});
    fs::create_directory_symlink(place.yard, place.folder.path / "other");
    CHECK(run_diurna("check '" + (place.folder.path / "other/scene.toml").string() + "'").code ==
          0);
    fs::create_symlink(place.yard / "scene.toml", place.yard / "inner/again.toml");
    CHECK(run_diurna("check '" + (place.yard / "inner/again.toml").string() + "'").code == 2);
}

TEST_CASE("a scene named from its own folder has that folder", "[confinement]") {
    const Place place;
    place.write({});
    const std::string there = "cd '" + place.yard.string() + "' && ";
    CHECK(run_diurna("check scene.toml", there).code == 0);
    CHECK(run_diurna("check ./inner/../scene.toml", there).code == 0);
    place.write({.weather = "none.csv"});
    CHECK_THAT(run_diurna("check scene.toml", there).out,
               Catch::Contains("no such file: none.csv"));
    place.write({.weather = "../outside/none.csv"});
    CHECK_THAT(run_diurna("check scene.toml", there).out, Catch::Contains(beyond));
}

TEST_CASE("a column reads no file beyond its folder", "[confinement]") {
    const Place place;
    const fs::path target = place.outside / "weather.csv";
    fs::copy_file(place.yard / "weather.csv", target);
    const auto column = [&](const std::string& weather, const std::string& material) {
        write_text(place.yard / "column.toml",
                   "[site]\nlatitude_deg = 36.0\nlongitude_deg = -84.0\n[material]\n" + material +
                       "[weather]\nfile = \"" + weather +
                       "\"\ninterval = \"instant\"\n[time]\nstart = 2026-07-15T00:00:00-04:00\n"
                       "end = 2026-07-15T12:00:00-04:00\n");
        return place.yard / "column.toml";
    };
    const auto code = [](const fs::path& file, const std::string& more = "") {
        return run_diurna("column '" + file.string() + "' " + more).code;
    };
    const std::string grass = "name = \"grass\"\n";
    CHECK(code(column("weather.csv", grass)) == 0);
    CHECK(code(column(target.string(), grass)) == 2);
    CHECK(code(column(target.string(), grass), "--allow-outside") == 0);
    CHECK(code(column("../outside/weather.csv", grass)) == 2);
    CHECK(code(column("weather.csv", grass + "reflectance = \"/etc/passwd\"\n")) == 2);
}
