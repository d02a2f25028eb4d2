#include "scenes/job/plan/sweep_folder.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>

#include "materials/base/error.hpp"
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
