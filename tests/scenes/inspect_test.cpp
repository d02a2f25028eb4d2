#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <string>

#include "tests/support/independent_reader.hpp"
#include "tests/support/small_scene.hpp"

// What `diurna inspect` says of files, beside what third-party programs find in them.

namespace {

namespace fs = std::filesystem;

Ran inspected(const fs::path& file) {
    return ran("'" DIURNA_BINARY "' inspect '" + file.string() + "' 2>&1");
}

}  // namespace

TEST_CASE("other readers find in files what inspect prints", "[scenes][inspect]") {
    if (!independent_readers()) return;
    const ScratchFolder folder("inspect");
    write_text(folder.path / "scene.toml", small_scene());
    const Ran solved = ran("'" DIURNA_BINARY "' solve '" + (folder.path / "scene.toml").string() +
                           "' --set time.duration_h=2 --out '" +
                           (folder.path / "temperatures.nc").string() + "' 2>&1");
    INFO(solved.out);
    REQUIRE((solved.code == 0 || solved.code == 1));  // two hours repeat badly
    const Ran read = read_by("inspect_reader.py", "'" DIURNA_BINARY "' '" DIURNA_SOURCE_DIR "' '" +
                                                      folder.path.string() + "'");
    INFO(read.out);
    CHECK(read.code == 0);
}

TEST_CASE("inspect distinguishes text files and suggests the next command", "[scenes][inspect]") {
    const ScratchFolder folder("inspect_texts");
    for (const auto& [name, text] : std::map<std::string, std::string>{
             {"yolo.txt", "0 0.5 0.5 0.25 0.125\n1 0.1 0.2 0.3 0.4\n"},
             {"kitti.txt", "truck 0.00 0 0.5 21 17 51 36 10.2 2.0 6.0 0.0 462.2 2282.5 0.5\n"},
             {"train.txt", "images/east_8-12.png\n"},
             {"shapes.geojson", R"({"type": "FeatureCollection", "features": [{}, {}]})"},
             {"annotations.json", R"({"images": [{}], "annotations": [{}, {}, {}],
                 "categories": [{"id": 1, "name": "truck"}]})"},
             {"sonde.csv",
              "height_m,pressure_hPa,temperature_C,relative_humidity_percent\n320,975,24,40\n"
              "1320,870,14,40\n"},
             {"grey.csv", "wavelength_um,reflectance\n8,0.05\n12,0.06\n"},
             {"way.csv", "time_s,east_m,north_m\n0,1,2\n10,3,4\n"},
             {"manifest.json", R"({"program": "diurna 0.1.0", "scene": "s", "state": "done"})"}}) {
        write_text(folder.path / name, text);
    }
    const fs::path place = DIURNA_SOURCE_DIR "/scenes/jacksboro";
    for (const auto& [file, says] : std::map<fs::path, std::string>{
             {folder.path / "yolo.txt", "labels (YOLO)\nboxes: 2\n"},
             {folder.path / "kitti.txt", "labels (KITTI)\nobjects: 1\n"},
             {folder.path / "train.txt", "list of pictures\npictures: 1\n"},
             {folder.path / "shapes.geojson", "shapes (GeoJSON)\nfeatures: 2\n"},
             {folder.path / "annotations.json", "labels (COCO)\nimages: 1\nannotations: 3\n"},
             {folder.path / "sonde.csv", "sounding\nlevels: 2\nlowest_height_m: 320\n"},
             {folder.path / "grey.csv", "spectrum\nrows: 2\n"},
             {folder.path / "way.csv", "trajectory\nrows: 2\n"},
             {folder.path / "manifest.json", "manifest of a run\n"},
             {folder.path, "next: diurna verify "},
             {place / "scene.toml", "scene\nnext: diurna check "},
             {place / "column.toml", "column\nnext: diurna column "},
             {place / "idling.parts.toml", "parts of a target\n"},
             {place / "trucks.png", "picture\nformat: PNG\n"}}) {
        const Ran reported = inspected(file);
        CAPTURE(file, reported.out);
        CHECK(reported.code == 0);
        CHECK(reported.out.find(says) != std::string::npos);
    }
}

TEST_CASE("inspect reads weather of other names and separators, and says how",
          "[scenes][inspect]") {
    const ScratchFolder folder("inspect_foreign");
    for (const auto& [name, text] : std::map<std::string, std::string>{
             {"semicolons.csv",
              "time_utc;Temp (C);wind (km/h)\n2026-07-15T12:00;20,5;3,6\n"
              "2026-07-15T13:00;21,5;7,2\n"},
             {"tabs.txt",
              "time_utc\tTemp (C)\twind (km/h)\n2026-07-15T12:00\t20.5\t3.6\n"
              "2026-07-15T13:00\t21.5\t7.2\n"},
             {"blanks.csv",
              "time_utc  Temp_C  wind_km/h\n2026-07-15T12:00  20.5 3.6\n"
              "2026-07-15T13:00  21.5 7.2\n"}}) {
        write_text(folder.path / name, text);
        const Ran reported = inspected(folder.path / name);
        CAPTURE(name, reported.out);
        CHECK(reported.code == 0);
        CHECK(reported.out.find("weather") == 0);
        CHECK(reported.out.find("rows: 2") != std::string::npos);
        CHECK(reported.out.find("air_temperature degC") != std::string::npos);
        CHECK(reported.out.find("wind_speed_m_s") != std::string::npos);
        CHECK(reported.out.find("294.65") != std::string::npos);
    }
    write_text(folder.path / "other.csv", "Zeit;Luft;Wind (m/s)\n1;2;3\n");
    const Ran reported = inspected(folder.path / "other.csv");
    CAPTURE(reported.out);
    CHECK(reported.code == 2);
    CHECK(std::count(reported.out.begin(), reported.out.end(), '\n') == 1);
    CHECK(reported.out.find("'Zeit', 'Luft', 'Wind (m/s)'") != std::string::npos);
    CHECK(reported.out.find("air_temperature_K") != std::string::npos);
    CHECK(reported.out.find("\"wind_speed m/s\"") != std::string::npos);
}

TEST_CASE("what inspect does not know gets one line and code 2", "[scenes][inspect]") {
    const ScratchFolder folder("inspect_unknown");
    for (const auto& [name, text] :
         std::map<std::string, std::string>{{"empty", ""},
                                            {"page.html", "<html></html>"},
                                            {"bytes.bin", "\x01\x02\x03"},
                                            {"broken.json", "{"},
                                            {"other.json", "[1, 2]"},
                                            {"other.toml", "a = 1\n"},
                                            {"broken.toml", "a = \n"},
                                            {"table.csv", "a,b\n1,2\n"},
                                            {"words.txt", "hello there\n"},
                                            {"broken.tif", "II*\x01"},
                                            {"broken.exr", "\x76\x2f\x31\x01zzzz"},
                                            {"broken.nc", "CDF\x01zzzz"},
                                            {"broken.obj", "v 1 2\n"},
                                            {"deep.json", std::string(200'000, '[')}}) {
        write_text(folder.path / name, text);
        const Ran reported = inspected(folder.path / name);
        CAPTURE(name, reported.out);
        CHECK(reported.code == 2);
        CHECK(std::count(reported.out.begin(), reported.out.end(), '\n') == 1);
        CHECK(reported.out.find(name) != std::string::npos);
    }
    fs::create_directory(folder.path / "folder");
    CHECK(inspected(folder.path / "folder").code == 2);
    CHECK(inspected(folder.path / "none").code == 2);
}
