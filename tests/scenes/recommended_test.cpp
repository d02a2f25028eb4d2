#include "scenes/job/run/recommended.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/heat.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// A hall on concrete, seen from above, by few rays.
std::string hall(double edge, double tolerance) {
    const std::string text = with(small_scene(), R"([[building]])",
                                  fmt::format(R"([[ground]]
name = "yard"
material = "concrete"
rectangle_m = [53.0, -88.4, 160.0, 160.0, 0.0]
largest_edge_m = {}
[[building]])",
                                              edge));
    return fmt::format("tolerance_K = {}\n", tolerance) +
           with(with(with(text, "sky_rays = 32", "sky_rays = 16\nobject_sky_rays = 16"),
                     "radius_m = 4000.0", "radius_m = 1000.0"),
                "place_m = [2000.0, 1100.0]\nheight_above_ground_m = 450.0\nlook_at_m = [0.0, 0.0]",
                "place_m = [153.0, 1.6]\nheight_above_ground_m = 120.0\nlook_at_m = [53.0, "
                "-88.4]");
}

CheckError checked(const ScratchFolder& folder, const std::string& text,
                   const std::vector<std::string>& settings) {
    write_text(folder.path / "scene.toml", text);
    const Prepared prepared = prepare(read_scene(folder.path / "scene.toml", settings));
    Progress silent(ProgressStyle::silent);
    return solve_scene(Stages(prepared), silent, {.check_points = 256}).check;
}

}  // namespace

// Expected numbers: mean squares that fall as one over the number of rays.
TEST_CASE("the largest part alone is reduced where that is enough", "[scenes][recommended]") {
    Scene scene;
    scene.object_sky_rays = 256;
    const ErrorParts parts{.ground_rays = 0.0005, .object_rays = 0.04, .size = 0.001};
    const std::vector<Recommended> set = recommended_settings(parts, scene, 0.1);
    REQUIRE(set.size() == 1);
    CHECK(set[0].key == "scene.object_sky_rays");
    CHECK(0.04 * 256.0 / set[0].value + 0.0015 <= 0.01);
    CHECK(0.04 * 256.0 / (0.5 * set[0].value) + 0.0015 > 0.81 * 0.01);  // not more than needed
    CHECK(recommended_settings(parts, scene, 0.3).empty());
    CHECK(recommended_settings(parts, scene, 0.0).empty());
}

TEST_CASE("where several parts are large all of them are reduced, within the keys' ranges",
          "[scenes][recommended]") {
    Scene scene;
    scene.sky_rays = 4096;  // its limit: no further reduction
    const ErrorParts parts{
        .ground_rays = 0.02, .object_rays = 0.02, .sun_rays = 0.02, .size = 0.02};
    const std::vector<Recommended> set = recommended_settings(parts, scene, 0.2);
    REQUIRE(set.size() == 3);
    double left = parts.ground_rays;
    for (const Recommended& one : set) {
        CHECK(one.key != "scene.sky_rays");
        CHECK(one.value <= 4096.0);
        left += one.key == "scene.object_sky_rays" ? 0.02 * scene.object_sky_rays / one.value
                : one.key == "scene.sun_samples"   ? 0.02 * scene.sun_samples / one.value
                                                   : 0.02 * scene.finer_edges / one.value;
    }
    CHECK(std::sqrt(left) <= 0.2);
}

// The second run, with the settings that the first one recommends, is judged by its own places.
TEST_CASE("a run with the recommended settings meets its tolerance",
          "[scenes][recommended][by_variation]") {
    const ScratchFolder folder("recommended");
    const double tolerance = 0.09;
    const CheckError before = checked(folder, hall(16.0, tolerance), {});
    CAPTURE(before.rms, before.low, before.parts.ground_rays, before.parts.object_rays,
            before.parts.sun_rays, before.parts.size, in_words(before.set));
    REQUIRE(before.low > tolerance);
    REQUIRE_FALSE(before.set.empty());
    std::vector<std::string> settings;
    for (const Recommended& one : before.set) {
        settings.push_back(fmt::format("{}={:g}", one.key, one.value));
    }
    const CheckError after = checked(folder, hall(16.0, tolerance), settings);
    CAPTURE(after.rms, after.low, after.high);
    CHECK(after.rms < tolerance);
}
