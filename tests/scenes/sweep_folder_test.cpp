#include "scenes/job/plan/sweep_folder.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>

#include "materials/base/error.hpp"
#include "scenes/app/sweep/checked_folder.hpp"
#include "scenes/job/run/listed_outputs.hpp"
#include "scenes/products/export/inspect.hpp"
#include "scenes/products/export/run_heat.hpp"
#include "scenes/products/report/movie.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace diurna;
namespace fs = std::filesystem;

namespace {

void put(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
}

std::string thrown(const std::function<void()>& work) {
    try {
        work();
    } catch (const InputError& error) {
        return error.mistakes().front().line();
    }
    return "nothing";
}

}  // namespace

TEST_CASE("a sweep is not written into a folder that holds other files", "[sweep]") {
    using Catch::Contains;
    const ScratchFolder place("sweep-folder-files");
    const auto refused = [&](const char* name, const std::vector<fs::path>& inputs = {}) {
        return thrown([&] { check_sweep_folder(place.path / name, inputs, false); });
    };
    // Folders of a sweep's names alone make no sweep's results.
    put(place.path / "a/variants/mine.txt", "x");
    put(place.path / "b/variants/v0/frames/mine.exr", "x");
    put(place.path / "c/heat/mine.nc", "x");
    put(place.path / "d/annotations.json", "x");
    fs::create_directories(place.path / "d/variants");
    for (const char* name : {"a", "b", "c", "d"}) {
        CHECK_THAT(refused(name), Contains("not results of a run"));
    }
    // A sweep that was begun, with other files in it, one at a time.
    const fs::path out = place.path / "out";
    put(out / "variants/v0/variant.json",
        R"({"key": "k", "done": true, "outputs": {"frames/a.exr": "1"}})");
    put(out / "variants/v0/frames/a.exr", "x");
    put(out / "heat/h0/temperatures.nc", "CDF\2");
    put(out / "heat/h1/done.json", "{}");
    fs::create_directories(out / "variants/v1/frames");
    CHECK(refused("out") == "nothing");
    for (const char* file :
         {"variants/mine.txt", "variants/v0/frames/mine.exr", "variants/v1/notes.txt",
          "heat/mine.nc", "heat/h0/mine.nc", "heat/h1/report.txt", "heat/h1/temperatures.nc"}) {
        CAPTURE(file);
        put(out / file, "x");
        CHECK_THAT(refused("out"), Contains("which was not written by an earlier run"));
        CHECK(fs::exists(out / file));
        fs::remove(out / file);
    }
    CHECK(refused("out") == "nothing");
    CHECK_THAT(refused("out", {out / "july.csv"}), Contains("an input of this run"));
}

TEST_CASE("messages about a sweep's folders name the folder that the command needs",
          "[sweep][words]") {
    using Catch::Contains;
    const ScratchFolder place("sweep-folder");
    const fs::path out = place.path / "out";
    put(out / "variants/v0/variant.json", "{\"key\": \"k\", \"heat\": \"h1\"}");
    put(out / "variants/v1/variant.json", "{\"key\": \"k\", \"heat\": \"h0\"}");
    put(out / "heat/h0/done.json", "{\"key\": \"k\"}");
    put(out / "heat/h0/temperatures.nc", "");
    const std::string v0 = (out / "variants/v0").string(), sweep = out.string();

    CHECK(is_sweep_folder(out));
    CHECK(sweep_around(v0) == out);
    CHECK(sweep_around(v0 + "/") == out);
    CHECK(sweep_around(out).empty());
    MovieOptions movie;
    movie.folder = out;
    movie.file = out / "a.mp4";
    CHECK_THAT(thrown([&] { write_movie(movie); }), Contains("folder of a sweep") && Contains(v0));
    CHECK_THAT(thrown([&] { load_run_heat(out); }), Contains((out / "heat/h0").string()));
    CHECK_THAT(thrown([&] { load_run_heat(v0); }), Contains((out / "heat/h1").string()));
    CHECK_THAT(thrown([&] { verify(v0); }), Contains("diurna verify " + sweep));
    CHECK_THAT(thrown([&] { inspect(v0); }), Contains("diurna inspect " + sweep));
    CHECK_THAT(thrown([&] { inspect(out); }), Contains("not complete") && Contains(v0));
    CHECK_THAT(verify(out).front(), Contains("sweep is not complete"));
    // Other folders get no such hint.
    put(place.path / "plain/frames/a.txt", "");
    CHECK(variant_hint(place.path / "plain").empty());
    CHECK(heat_hint(place.path / "plain").empty());
}
