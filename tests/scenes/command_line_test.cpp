#include <fmt/format.h>
#include <sys/wait.h>
#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/folder_contents.hpp"
#include "tests/support/ran.hpp"
#include "tests/support/small_scene.hpp"

// The program as a user has it: what it prints, its exit codes, what it writes.

namespace {

namespace fs = std::filesystem;

Ran diurna(const std::string& arguments) {
    const std::string command = "'" DIURNA_BINARY "' " + arguments + " 2>&1";
    return ran(command);
}

std::size_t lines(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("the sun of NREL's SPA example", "[command_line]") {
    // Reda & Andreas 2004, NREL/TP-560-34302, table A5.1: zenith 50.11162, azimuth 194.34024.
    const Ran ran = diurna(
        "sun --latitude-deg 39.742476 --longitude-deg -105.1786 --height-m 1830.14 --time "
        "2003-10-17T12:30:30-07:00 --pressure-hPa 820 --temperature-C 11");
    REQUIRE(ran.code == 0);
    double azimuth = 0, elevation = 0;
    REQUIRE(std::sscanf(ran.out.c_str(), "azimuth_deg,elevation_deg,distance_au\n%lf,%lf", &azimuth,
                        &elevation) == 2);
    CHECK(azimuth == Approx(194.34024).margin(5e-4));
    CHECK(90.0 - elevation == Approx(50.11162).margin(5e-4));
}

TEST_CASE("the sky and the shadows of a raster's posts", "[command_line]") {
    const Ran ran = diurna("visibility " DIURNA_SOURCE_DIR
                           "/scenes/jacksboro/elevation.tif --azimuths 16 --sun-azimuth-deg 90 "
                           "--sun-elevation-deg 8");
    REQUIRE(ran.code == 0);
    int columns = 0, rows = 0;
    double mean = 0, least = 0, lit = 0;
    const auto values = ran.out.find('\n');
    REQUIRE(values != std::string::npos);
    REQUIRE(std::sscanf(ran.out.c_str() + values, " %d,%d,0,16,%lf,%lf,%lf", &columns, &rows, &mean,
                        &least, &lit) == 5);
    CHECK(columns == 403);
    CHECK(rows == 344);
    CHECK((mean > 0.9 && mean < 1.0));
    CHECK((least > 0.4 && least < mean));
    CHECK((lit > 0.5 && lit < 1.0));
    CHECK(diurna("visibility none.tif").code == 2);
    CHECK(diurna("visibility " DIURNA_SOURCE_DIR
                 "/scenes/jacksboro/elevation.tif --sun-azimuth-deg 90")
              .code == 2);
}

TEST_CASE("bad usage gets one line and code 2", "[command_line]") {
    for (const auto& [arguments, expected] : std::map<std::string, std::string>{
             {"rnu scene.toml", "did you mean 'run'?"},
             {"run", "SCENE is required"},
             {"check nowhere.toml", "nowhere.toml: no such file"},
             {"sun --latitude-deg 95 --longitude-deg 0 --time 2026-01-01T00:00:00Z",
              "--latitude-deg: found '95', expected -90 to 90"},
             {"sun --latitude-deg 5 --longitude-deg 0 --time yesterday", "--time"},
             {"path --band 8:12 --profile MLSS --to-space", "did you mean 'MLS'?"},
             {"path --band 12:8 --to-space", "12"},
             {"path --band 8:12", "expected one of range_km"},
             {"path --band 8:12 --zenith-deg 120 --to-space", "ends at the ground"},
             {"mesh nowhere.tif --tolerance-m 1", "nowhere.tif"},
             {"column nowhere.toml", "nowhere.toml: no such file"},
             {"calibrate nowhere.toml", "nowhere.toml: no such file"},
         }) {
        CAPTURE(arguments);
        const Ran ran = diurna(arguments);
        CAPTURE(ran.out);
        CHECK(ran.code == 2);
        CHECK(lines(ran.out) == 1);
        CHECK(ran.out.find(expected) != std::string::npos);
    }
}

TEST_CASE("help and version are no mistakes", "[command_line]") {
    CHECK(diurna("--help").code == 0);
    CHECK(diurna("run --help").code == 0);
    CHECK(diurna("--version").out.find("diurna ") == 0);
    CHECK(diurna("doctor").code == 0);
}

TEST_CASE("a scene that cannot be used writes nothing", "[command_line]") {
    const ScratchFolder folder("bad-scene");
    const fs::path scene = folder.path / "scene.toml", out = folder.path / "out";
    const fs::path empty = folder.path / "empty.tif";
    write_text(empty, "");
    const std::string observer = "height_above_ground_m = 450.0";
    for (const auto& [text, expected] : std::map<std::string, std::string>{
             {with(small_scene(), "tolerance_m", "tolerence_m"), "scene.toml:10:1"},
             {with(small_scene(),
                   std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/elevation.tif",
                   empty.string()),
              "empty.tif"},
             {with(small_scene(), "place_m = [2000.0, 1100.0]", "place_m = [2e6, 0.0]"),
              ":39:11: observer.place_m: east 2e+06 m"},
             {with(small_scene(), "latitude_deg = 36.32", "latitude_deg = 12.0"), "12.0"},
             {small_scene().substr(0, small_scene().find("[[observer]]")), "[[observer]]"},
         }) {
        write_text(scene, text);
        const Ran ran = diurna("run " + scene.string() + " --out " + out.string());
        CAPTURE(expected, ran.out);
        CHECK(ran.code == 2);
        CHECK(lines(ran.out) == 1);
        CHECK(ran.out.find(expected) != std::string::npos);
        CHECK_FALSE(fs::exists(out));
    }
}

TEST_CASE("a job gives the same bytes for 1, 2 and 4 threads, and resumes", "[command_line]") {
    const ScratchFolder folder("job");
    const fs::path scene = folder.path / "scene.toml";
    write_text(scene, small_scene() + "[output]\nstate = true\n");
    const auto run = [&](const std::string& out, const std::string& more) {
        const Ran ran =
            diurna("run " + scene.string() + " --out " + (folder.path / out).string() + " " + more);
        CAPTURE(ran.out);
        REQUIRE(ran.code == 0);
        return ran;
    };
    run("one", "--threads 1");
    run("two", "--threads 2");
    run("four", "--threads 4");
    auto one = contents(folder.path / "one");
    auto two = contents(folder.path / "two");
    auto four = contents(folder.path / "four");
    // 4 instants x 2 bands: EXR, quick-look, grey picture, YOLO's and KITTI's text, KITTI's
    // calibration each; temperatures, state in double precision, report, manifest, ledger; three of
    // COCO's, two lists of pictures, two of classes.
    CHECK(one.size() == 6 * 8 + 5 + 7);
    for (const std::string timed : {"report.html", "manifest.json"}) {  // they tell seconds
        REQUIRE(one.count(timed) == 1);
        one.erase(timed);
        two.erase(timed);
        four.erase(timed);
    }
    CHECK(one == two);
    CHECK(one == four);

    // Killed after some frames: what is there stays, what is missing comes back the same.
    for (const auto& [name, text] : one) {
        if (name.find("8-12") != std::string::npos) fs::remove(folder.path / "one" / name);
    }
    const Ran resumed = run("one", "--resume");
    CHECK(resumed.out.find("heat balance   ") == std::string::npos);
    auto again = contents(folder.path / "one");
    again.erase("report.html");
    again.erase("manifest.json");
    CHECK(again == one);
    CHECK(run("one", "--resume").out.find("0 views rendered") != std::string::npos);
}

// A surface that can lose no heat has no periodic day.
const std::string heat_trap = R"(albedo = 0.98
emissivity = 0.0
roughness_length_m = 0.01
convection = { kind = "constant", value_W_m2K = 0.0 }
layers = [{ thickness_m = 0.1, conductivity_W_mK = 1.0, density_kg_m3 = 2000.0, heat_capacity_J_kgK = 900.0 }]
)";

TEST_CASE("a run that does not converge keeps its results, says so and fails", "[command_line]") {
    const ScratchFolder folder("heat-trap");
    const fs::path scene = folder.path / "scene.toml", out = folder.path / "out";
    write_text(scene, with(with(small_scene(), "\"painted_steel\"", "\"trap\""),
                           "radius_m = 4000.0", "radius_m = 3000.0") +
                          "[material.trap]\n" + heat_trap);
    const std::string place = scene.string() + " --out " + out.string();
    const Ran ran = diurna("run --progress none " + place);
    CAPTURE(ran.out);
    CHECK(ran.code == 1);
    std::size_t reported = 0;  // what is modelled, and the effect of the start
    for (std::size_t at = 0; (at = ran.out.find("note: ", at)) != std::string::npos; ++at)
        ++reported;
    CHECK(reported >= 2);
    CHECK(lines(ran.out) == 3 + reported);  // a warning of ground beyond the raster
    CHECK(ran.out.find("periodic solution not converged: residual ") != std::string::npos);
    CHECK(
        ran.out.find("diurna: the heat balance has not converged in 12 passes: estimated error ") !=
        std::string::npos);
    auto written = contents(out);
    CHECK(written.size() == 6 * 8 + 4 + 7);
    CHECK(written.at("report.html").find("the heat balance has not converged") !=
          std::string::npos);
    CHECK(written.at("manifest.json").find("\"not_converged\"") != std::string::npos);
    // What is kept of it has not converged either.
    const Ran again = diurna("run --resume --progress none " + place);
    CHECK(again.code == 1);
    CHECK(again.out.find("has not converged in 12 passes") != std::string::npos);
    const Ran solved = diurna("solve --progress none " + scene.string() + " --out " +
                              (folder.path / "t.nc").string());
    CHECK(solved.code == 1);
    CHECK(fs::exists(folder.path / "t.nc"));
}

TEST_CASE("a column that does not converge keeps its results, says so and fails",
          "[command_line]") {
    const ScratchFolder folder("column-trap");
    const std::string weather = std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/weather.csv";
    const auto column = [&](const std::string& material) {
        write_text(folder.path / "column.toml",
                   "[site]\nlatitude_deg = 36.32\nlongitude_deg = -84.2\n[weather]\nfile = \"" +
                       weather + "\"\ninterval = \"instant\"\n[time]\nspin_up = \"periodic\"\n" +
                       "start = 2026-07-15T00:00:00-04:00\nend = 2026-07-16T00:00:00-04:00\n" +
                       "[material]\n" + material);
        return diurna("column " + (folder.path / "column.toml").string() + " --out " +
                      (folder.path / "out.csv").string());
    };
    CHECK(column("name = \"asphalt\"\n").code == 0);
    const Ran ran = column(heat_trap);
    CAPTURE(ran.out);
    CHECK(ran.code == 1);
    CHECK(ran.out.find("diurna: the spin-up has not converged in ") != std::string::npos);
    CHECK(lines(contents(folder.path).at("out.csv")) == 49 + 1);  // its header
}

TEST_CASE("a calibration writes its four files with the same bytes, or no file", "[command_line]") {
    const ScratchFolder folder("calibration");
    const std::string weather = std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/weather.csv",
                      file = (folder.path / "column.toml").string();
    write_text(folder.path / "measured.csv",
               "time,skin\n2026-07-15T05:00:00-04:00,292\n2026-07-15T09:00:00-04:00,305\n"
               "2026-07-15T13:00:00-04:00,325\n2026-07-15T19:00:00-04:00,309\n");
    const auto calibrate = [&](const std::string& high, const std::string& out,
                               const std::string& more = "") {
        write_text(
            folder.path / "column.toml",
            "[site]\nlatitude_deg = 36.32\nlongitude_deg = -84.2\n[weather]\nfile = \"" + weather +
                "\"\ninterval = \"instant\"\n[time]\n" +
                "start = 2026-07-15T00:00:00-04:00\nend = 2026-07-16T00:00:00-04:00\n" +
                "[material]\nname = \"asphalt\"\n[calibrate]\nmeasured = \"measured.csv\"\n" +
                "sought = [{ key = \"material.albedo\", low = 0.05, high = " + high + " }]\n");
        return diurna("calibrate '" + file + "' --out '" + (folder.path / out).string() + "' " +
                      more);
    };
    const Ran found = calibrate("0.4", "out");
    CAPTURE(found.out);
    CHECK(found.code == 0);
    const auto files = contents(folder.path / "out");
    REQUIRE(files.size() == 4);
    for (const char* one : {"calibrate.csv", "calibrate.json", "calibrate.svg"}) {
        CHECK(files.count(one) == 1);
    }
    CHECK(lines(files.at("calibrate_curve.csv")) == 1 + 4);
    CHECK(calibrate("0.4", "again").code == 0);
    CHECK(contents(folder.path / "again") == files);

    const Ran bad = calibrate("1.4", "none");
    CAPTURE(bad.out);
    CHECK(bad.code == 2);
    CHECK(lines(bad.out) == 1);
    const Ran deep = calibrate("0.4", "none", "--set calibrate.depth_m=90");
    CAPTURE(deep.out);
    CHECK(deep.code == 2);
    CHECK(lines(deep.out) == 1);
    CHECK_FALSE(fs::exists(folder.path / "none"));
}

TEST_CASE("a model as a file of its own", "[command_line]") {
    const ScratchFolder folder("model");
    const std::string file = (folder.path / "van.obj").string();
    CHECK(lines(diurna("model").out) == 12);
    CHECK(diurna("model truck --detail low --out " + file).code == 0);
    CHECK(fs::is_regular_file(folder.path / "van.parts.toml"));
    CHECK(diurna("model truck").code == 2);
    CHECK(diurna("model truck --out van.ply").code == 2);
    CHECK(diurna("model truck --detail fine --out " + file).code == 2);
    const Ran unknown = diurna("model trukc --out " + file);
    CHECK(unknown.code == 2);
    CHECK(unknown.out.find("did you mean 'truck'") != std::string::npos);
}

TEST_CASE("studies of an object write the same bytes on any number of threads", "[command_line]") {
    const ScratchFolder folder("studies");
    const fs::path scene = folder.path / "scene.toml";
    write_text(scene, small_scene());
    for (const char* verb : {"signature", "detection"}) {
        const Ran without = diurna(std::string(verb) + " --progress none " + scene.string());
        CHECK(without.code == 2);
        CHECK(without.out.find("no table [[" + std::string(verb) + "]]") != std::string::npos);
    }
    write_text(scene, small_scene() + R"(
[[signature]]
object = "hangar"
bands = ["3-5", "8-12"]
directions = 42
pixels = 48
[instrument]
preset = "cooled_mwir"
band = "3-5"
[[detection]]
object = "hangar"
)");
    const std::string heat = (folder.path / "t.nc").string();
    REQUIRE(diurna("solve --progress none " + scene.string() + " --out " + heat).code == 0);
    for (const char* verb : {"signature", "detection"}) {
        const auto ran_on = [&](int threads) {
            const fs::path out = folder.path / fmt::format("{}{}", verb, threads);
            const Ran ran =
                diurna(fmt::format("{} --progress none --threads {} {} --temperatures "
                                   "{} --out {}",
                                   verb, threads, scene.string(), heat, out.string()));
            CAPTURE(ran.out);
            CHECK(ran.code == 0);
            return contents(out);
        };
        const auto one = ran_on(1);
        CHECK(one.size() == 3);
        CHECK(one.count("hangar.csv") + one.count("hangar.json") + one.count("hangar.svg") == 3);
        CHECK(one == ran_on(2));
        const auto from = nlohmann::json::parse(one.at("hangar.json")).at("made_from");
        CHECK(from.at("scene") == "scene.toml");
        CHECK(from.at("settings").empty());
        CHECK(from.at("heat_sha256").get<std::string>().size() == 64);
    }
}
