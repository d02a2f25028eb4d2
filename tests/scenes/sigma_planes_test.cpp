#include "scenes/job/run/sigma_planes.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/frame_files.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

JobReport run_of(const std::filesystem::path& file, const std::vector<std::string>& settings,
                 const std::filesystem::path& out, bool resume = false) {
    return run_job(read_scene(file, settings, true),
                   {.out = out,
                    .settings = settings,
                    .resume = resume,
                    .scene_with = reads_scene(file, settings, true)});
}

constexpr const char* two_values =
    R"(uncertain = [{ key = "weather.changed.wind_factor", one_sigma = 1.2 },
             { key = "material.grass.albedo", one_sigma = 0.25 }]
[scene])";

const std::string wind = "weather.changed.wind_factor=1.2", paint = "material.grass.albedo=0.25";

}  // namespace

// The expected values are pictures of three runs of their own, each of the scene as it is or with
// one value changed, from which the root sum square is taken here.
TEST_CASE("sigma planes are the root sum square of what uncertain values change",
          "[scenes][uncertain][by_variation]") {
    const ScratchFolder folder("sigma_planes");
    const std::filesystem::path file = folder.path / "scene.toml";
    write_text(file, with(small_scene(), "[scene]", two_values));
    const JobReport report = run_of(file, {}, folder.path / "sigma");
    const std::vector<std::string> none{"uncertain=[]"};
    const auto changed = [&](const std::string& setting) {
        return std::vector<std::string>{"uncertain=[]", setting};
    };
    run_of(file, none, folder.path / "base");
    run_of(file, changed(wind), folder.path / "wind");
    run_of(file, changed(paint), folder.path / "paint");
    const ObserverInput eye = read_scene(file, {}, true).observers.front();
    double squares = 0.0, apart = 0.0;
    std::size_t count = 0;
    for (const Instant when : eye.frames) {
        const std::string name = frame_base(eye.name, "8-12", when) + ".exr";
        const auto plane = [&](const char* run, const char* what) {
            return read_exr(folder.path / run / name)[what].pixel;
        };
        const char* shown = "apparent_temperature.8-12";
        const auto sigma = plane("sigma", "sigma.8-12"), as_is = plane("sigma", shown),
                   base = plane("base", shown), windy = plane("wind", shown),
                   painted = plane("paint", shown);
        CHECK(as_is == base);
        for (std::size_t p = 0; p < sigma.size(); ++p) {
            const double expected = std::hypot(double{windy[p]} - double{base[p]},
                                               double{painted[p]} - double{base[p]});
            squares += expected * expected;
            apart += (double{sigma[p]} - expected) * (double{sigma[p]} - expected);
            ++count;
        }
    }
    const double all = std::sqrt(squares / double(count)), off = std::sqrt(apart / double(count));
    CAPTURE(all, off);
    CHECK(all > 0.1);  // [K] wind and albedo change something
    CHECK(off < 2e-3);
    const auto says = [](const JobReport& of, const char* text) {
        return std::any_of(of.notes.begin(), of.notes.end(), [&](const std::string& note) {
            return note.find(text) != std::string::npos;
        });
    };
    CHECK(says(report, "their sum differs by"));
    // Nothing is rendered, so nothing is solved; the report says the same.
    const JobReport again = run_of(file, {}, folder.path / "sigma", true);
    CHECK(again.frames_rendered == 0);
    CHECK(says(again, "their sum differs by"));
}

TEST_CASE("an uncertain value that changes facets is refused before anything is written",
          "[scenes][uncertain][by_degenerate]") {
    const ScratchFolder folder("sigma_facets");
    const std::filesystem::path file = folder.path / "scene.toml";
    const std::string key =
        GENERATE("terrain.radius_m", "material.grass.albeedo", "observer.camera.width");
    write_text(file, with(small_scene(), "[scene]",
                          "uncertain = [{ key = \"" + key + "\", one_sigma = 3000.0 }]\n[scene]"));
    CHECK_THROWS_AS(run_of(file, {}, folder.path / "out"), InputError);
    CHECK_FALSE(std::filesystem::exists(folder.path / "out"));
}
