#include <fcntl.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "scenes/job/run/listed_outputs.hpp"
#include "scenes/job/store/inputs.hpp"
#include "tests/support/differing.hpp"
#include "tests/support/folder_contents.hpp"
#include "tests/support/ran.hpp"
#include "tests/support/small_scene.hpp"

// What a run finds in its folder counts only if it is what a run of the same inputs has written
// there; then the folder is, to the byte, that of a run in one go.

using namespace diurna;

namespace {

namespace fs = std::filesystem;

const PrivateTempFolder temp;

/// A scene whose every file is its own: a raster, weather, a spectrum, a mesh that names materials.
struct Place {
    ScratchFolder folder{"resume"};
    fs::path scene = folder.path / "scene.toml";
    Place() {
        const std::string from = DIURNA_SOURCE_DIR "/scenes/jacksboro/";
        for (const char* file : {"elevation.tif", "weather.csv"}) {
            fs::copy_file(from + file, folder.path / file);
        }
        write_text(folder.path / "paint.csv", "wavelength_um,reflectance\n0.3,0.6\n20,0.1\n");
        write_text(folder.path / "box.mtl", "newmtl a\n");
        write_text(
            folder.path / "box.obj",
            "mtllib box.mtl\nusemtl a\nv 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\n"
            "f 2 3 4\nf 1 4 3\n");
        std::string text = small_scene();
        for (std::size_t at; (at = text.find(from)) != std::string::npos;)
            text.erase(at, from.size());
        text = with(text, "material = \"grass\"", "material = \"paint\"");
        text = with(text, "radius_m = 4000.0", "radius_m = 2500.0");
        text = with(text, "sky_rays = 32", "sky_rays = 16");
        text = with(text, "step_s = 1200.0", "step_s = 3600.0");
        text = with(text, "frame_every_s = 21600.0", "frame_every_s = 43200.0");
        write_text(scene, text +
                              "[material.paint]\nlike = \"grass\"\nreflectance = \"paint.csv\"\n"
                              "[[object]]\nname = \"box\"\nmesh = \"box.obj\"\n"
                              "place_m = [0.0, 500.0]\nmaterial = \"asphalt\"\n");
    }
    JobReport run(const std::string& out, bool resume) const {
        return run_job(read_scene(scene),
                       {.out = folder.path / out, .settings = {}, .resume = resume});
    }
};

/// Without the seconds that a page and a manifest tell.
std::map<std::string, std::string> untimed(std::map<std::string, std::string> files) {
    std::string& page = files.at("report.html");
    const auto from = page.find("<h2>Time of this run"), to = page.find("<h2>Plan");
    REQUIRE(from < to);
    page.erase(from, to - from);
    std::string& manifest = files.at("manifest.json");
    manifest.erase(manifest.find("\"outputs\""));  // the page's digest, then seconds
    return files;
}

std::string find_file(const fs::path& folder, const std::string& extension, std::size_t number) {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == extension) found.push_back(entry.path().string());
    }
    std::sort(found.begin(), found.end());
    return found.at(number);
}

int code_of(const std::string& arguments) {
    const int status =
        std::system(("'" DIURNA_BINARY "' " + arguments + " >/dev/null 2>&1").c_str());
    return WEXITSTATUS(status);
}

}  // namespace

TEST_CASE("of an earlier run only what it has written is reused", "[resume]") {
    const Place place;
    const fs::path out = place.folder.path / "out";
    place.run("out", false);
    const auto whole = contents(out);
    CHECK(verify(out).empty());
    CHECK(code_of("verify '" + out.string() + "'") == 0);

    const JobReport kept = place.run("out", true);
    CHECK(kept.frames_rendered == 0);
    CHECK_FALSE(kept.solved);
    CHECK(kept.remade.empty());
    // The page of a run that finds all there says the same.
    CHECK(differing(untimed(contents(out)), untimed(whole)).empty());

    // An empty picture, another hour's frame, half a frame, one byte of the temperatures, a label
    // of another run among the labels: each is found, reported, and regenerated.
    const std::string png = find_file(out / "frames", ".png", 0);
    const std::string first = find_file(out / "frames", ".exr", 0);
    const std::string second = find_file(out / "frames", ".exr", 1);
    const std::string third = find_file(out / "frames", ".exr", 2);
    write_text(png, "");
    fs::copy_file(first, second, fs::copy_options::overwrite_existing);
    fs::resize_file(third, fs::file_size(third) / 2);
    CHECK(verify(out).size() == 3);
    CHECK(code_of("verify '" + out.string() + "'") == 1);
    const JobReport frames = place.run("out", true);
    CHECK(frames.frames_rendered == 2);
    CHECK_FALSE(frames.solved);
    REQUIRE(frames.remade.size() == 1);
    CHECK(frames.remade.front().find("3 files changed since the earlier run (for example ") == 0);
    CHECK(differing(untimed(contents(out)), untimed(whole)).empty());

    std::string heat = whole.at("temperatures.nc");
    heat[heat.size() / 2] = static_cast<char>(heat[heat.size() / 2] ^ 1);
    write_whole_file(out / "temperatures.nc", heat);
    const JobReport solved = place.run("out", true);
    CHECK(solved.solved);
    CHECK(solved.frames_rendered == 0);  // they are of the same temperatures
    CHECK(differing(untimed(contents(out)), untimed(whole)).empty());
    CHECK(verify(out).empty());
}

TEST_CASE("every file that a scene is made of is in the key", "[resume]") {
    const Place place;
    const auto inputs = [&] { return run_inputs(prepare(read_scene(place.scene)).scene); };
    const auto has = [&](const std::string& name) {
        const std::vector<RunInput> all = inputs();
        return std::any_of(all.begin(), all.end(),
                           [&](const RunInput& input) { return input.name == "scene/" + name; });
    };
    for (const char* name :
         {"scene.toml", "elevation.tif", "weather.csv", "paint.csv", "box.obj"}) {
        CAPTURE(name);
        CHECK(has(name));
    }
    const std::string aux = "elevation.tif.aux.xml";
    CHECK_FALSE(has(aux));
    const auto key = [&] { return job_key(inputs(), {}); };
    CHECK(job_key(inputs(), {"time.step_s=600"}) != key());
    // Each of them edited makes another key; by content, not by time.
    for (const auto& [name, text] : std::map<std::string, std::string>{
             {"paint.csv", "wavelength_um,reflectance\n0.3,0.1\n20,0.05\n"},
             {aux,
              "<PAMDataset><PAMRasterBand band=\"1\"><Offset>100</Offset><Scale>1</Scale>"
              "</PAMRasterBand></PAMDataset>"}}) {
        CAPTURE(name);
        const std::string before = key();
        write_text(place.folder.path / name, text);
        CHECK(key() != before);
    }
    CHECK(has(aux));
    const std::string before = key();
    fs::last_write_time(place.folder.path / "paint.csv", fs::file_time_type::clock::now());
    CHECK(key() == before);
    // The same scene in another folder is the same.
    fs::copy(place.folder.path, place.folder.path.string() + "-moved", fs::copy_options::recursive);
    const fs::path moved = place.folder.path.string() + "-moved";
    CHECK(job_key(run_inputs(prepare(read_scene(moved / "scene.toml")).scene), {}) == before);
    fs::remove_all(moved);
    // A file that changes after it was read is no input to be reported of.
    const Scene scene = prepare(read_scene(place.scene)).scene;
    write_text(place.folder.path / "paint.csv", "wavelength_um,reflectance\n0.3,0.2\n20,0.05\n");
    CHECK_THROWS_WITH(run_inputs(scene), Catch::Contains("paint.csv: changed while"));
}

TEST_CASE("a folder is refused before the scene is built", "[resume]") {
    const Place place;
    write_text(place.folder.path / "elevation.tif", "no raster");
    const fs::path out = place.folder.path / "out", file = place.folder.path / "weather.csv";
    const auto refused = [&](const fs::path& folder, const std::string& more = "") {
        const Ran got = ran("'" DIURNA_BINARY "' run '" + place.scene.string() + "' --out '" +
                            folder.string() + "' " + more + " 2>&1");
        CAPTURE(got.out);
        CHECK(got.code == 2);
        CHECK(std::count(got.out.begin(), got.out.end(), '\n') == 1);
        return got.out;
    };
    CHECK(refused(file).find("is not a folder") != std::string::npos);
    CHECK(refused(file / "in").find("cannot be created") != std::string::npos);
    CHECK(refused(place.folder.path).find("not results of a run") != std::string::npos);
    fs::create_directories(out / "frames");
    write_text(out / "manifest.json", R"({"program": "diurna", "outputs": {}})");
    write_text(out / "frames/mine.exr", "x");
    CHECK(refused(out).find("mine.exr, which was not written") != std::string::npos);
    CHECK(refused(out, "--from '" + out.string() + "'").find("--from") != std::string::npos);
    fs::remove(out / "frames/mine.exr");
    const int held = ::open(out.c_str(), O_RDONLY | O_DIRECTORY);
    REQUIRE(::flock(held, LOCK_EX | LOCK_NB) == 0);
    CHECK(refused(out).find("is in use by another run") != std::string::npos);
    ::close(held);
    CHECK(contents(out).size() == 1);
    // A free folder: then what is wrong with the scene is reported.
    CHECK(refused(place.folder.path / "new").find("elevation.tif") != std::string::npos);
    CHECK_FALSE(fs::exists(place.folder.path / "new"));
}

TEST_CASE("a folder is one run's alone", "[resume]") {
    const Place place;
    const fs::path out = place.folder.path / "out";
    const std::string run =
        "run '" + place.scene.string() + "' --progress none --resume --out '" + out.string() + "'";
    fs::create_directories(out);
    const int held = ::open(out.c_str(), O_RDONLY | O_DIRECTORY);
    REQUIRE(::flock(held, LOCK_EX | LOCK_NB) == 0);
    CHECK(code_of(run) == 2);
    CHECK(fs::is_empty(out));
    ::close(held);
    // Killed at several moments, it is taken up; a killed one holds no lock.
    for (const char* seconds : {"0.2", "0.5", "0.8", "1.1"}) {
        std::system(("timeout -s KILL " + std::string(seconds) + " '" DIURNA_BINARY "' " + run +
                     " >/dev/null 2>&1")
                        .c_str());
    }
    CHECK(code_of(run) == 0);
    CHECK(verify(out).empty());

    // Another file among the pictures is none of its own: reported, and left alone.
    write_text(out / "frames/mine.exr", "x");
    CHECK(verify(out) == std::vector<std::string>{"frames/mine.exr: not written by this run"});
    CHECK(code_of(run) == 2);
    CHECK(fs::exists(out / "frames/mine.exr"));
    fs::remove(out / "frames/mine.exr");
    // Pictures of an observer that the scene has no more go.
    const std::string old = find_file(out / "frames", ".exr", 0);
    write_text(place.scene, with(read_text(place.scene), "name = \"east\"", "name = \"west\""));
    CHECK(code_of(run) == 0);
    CHECK_FALSE(fs::exists(old));
    CHECK(verify(out).empty());

    // A folder of another kind is not touched.
    const fs::path home = place.folder.path / "home";
    fs::create_directories(home);
    write_text(home / "report.html", "mine");
    CHECK_THROWS_AS(run_job(read_scene(place.scene), {.out = home, .settings = {}}), InputError);
    CHECK_THROWS_AS(run_job(read_scene(place.scene), {.out = place.scene, .settings = {}}),
                    InputError);
    CHECK_THROWS_AS(run_job(read_scene(place.scene), {.out = place.folder.path, .settings = {}}),
                    InputError);
    CHECK(read_text(home / "report.html") == "mine");
    CHECK(contents(home).size() == 1);
}
