#include <catch2/catch.hpp>
#include <string>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/small_scene.hpp"

// Where the heat of a facet has no balance, a run ends, and reports whose and when.

using namespace diurna;

namespace {

const PrivateTempFolder temp;

}  // namespace

TEST_CASE("a facet whose balance has no solution is named, with its material and instant",
          "[scenes][solver]") {
    const ScratchFolder folder("unsolved");
    const auto scene = folder.path / "scene.toml";
    std::string text = with(small_scene(), "material = \"asphalt\"", "material = \"cold\"");
    text = with(text, "step_s = 1200.0", "step_s = 3600.0");
    text = with(text, "radius_m = 4000.0", "radius_m = 1500.0");
    text = with(text, "place_m = [2000.0, 1100.0]", "place_m = [900.0, 700.0]");
    // A hundred kilowatts are taken from each square metre: more than it has at any temperature.
    write_text(scene, text +
                          "[material.cold]\nlike = \"asphalt\"\n"
                          "internal_heat_W_m2 = -100000.0\n");
    CHECK_THROWS_WITH(
        run_job(read_scene(scene), {.out = folder.path / "out", .settings = {}, .resume = false}),
        Catch::Contains("the heat balance failed: facet ") &&
            Catch::Contains(" of cold at 2026-07-15T04:00:00") &&
            Catch::Contains("no solution from 1 to 5000 K"));
    CHECK_FALSE(std::filesystem::exists(folder.path / "out/temperatures.nc"));
}
