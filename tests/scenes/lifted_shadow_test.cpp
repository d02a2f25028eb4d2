#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/files.hpp"
#include "scenes/job/run/sun_exposure.hpp"
#include "terrain/place/sun.hpp"
#include "tests/support/sheet_scene.hpp"

// Shadows of what stands off the ground. Sunlight comes in parallel: a level plate's shadow on
// level ground is as large as the plate, at its height over the sun's tangent away from it.

using namespace diurna;
namespace over_plain = diurna::testing::over_plain;

namespace {

Prepared plate_over_coarse_plain(int size, double height, bool on_trajectory,
                                 const std::string& of_time = "") {
    const ScratchFolder folder("lifted");
    over_plain::write_scene(folder.path, {.mesh = over_plain::level_square(size),
                                          .height = height,
                                          .beam = 800.0,
                                          .ground_edge = 50.0});
    std::string text = read_text(folder.path / "scene.toml");
    const auto put = [&](const std::string& old, const std::string& next) {
        text.replace(text.find(old), old.size(), next);
    };
    if (on_trajectory) {
        put(fmt::format("place_m = [0.0, 0.0]\nheight_above_ground_m = {}\n", height),
            "trajectory = \"hover\"\n");
        text += fmt::format(
            "[[trajectory]]\nname = \"hover\"\nwaypoints_m = [[0, 0, {0}], [0, 0, {0}], "
            "[150, 0, {0}]]\ntimes_s = [0, 72000, 72060]\n",
            height);
    }
    put("start = 2026-03-20T00:00:00Z\n", "start = 2026-03-20T00:00:00Z\n" + of_time);
    write_text(folder.path / "scene.toml", text);
    return prepare(read_scene(folder.path / "scene.toml"));
}

struct Shadow {
    double area = 0.0;                                 // [m²] of lost beam
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();  // its mean place
};
Shadow shadow_at(const Prepared& prepared, Instant when) {
    const SunExposure sun = scene_sun_exposure(prepared, {when, later(when, 60.0)});
    const FacetSet& facets = prepared.world.facets;
    Shadow shadow;
    double fine = 0.0;  // [m²]
    for (std::size_t f = 0; f < prepared.world.ground_facets; ++f) {
        const double lost = double(facets.area[f]) * (1.0 - double(sun.fraction[f]));
        shadow.area += lost;
        // A shadow's edge on coarse ground says nothing of its place.
        if (facets.area[f] > 100.0f) continue;
        fine += lost;
        shadow.middle += lost * facets.centroid[f].head<2>().cast<double>();
    }
    shadow.middle /= fine;
    return shadow;
}

}  // namespace

TEST_CASE("a plate's shadow is as large as the plate, however high it hovers",
          "[scenes][shadow][by_closed_form]") {
    const int size = GENERATE(3, 4);
    const double height = GENERATE(0.5, 3.0, 10.0, 25.0);
    const bool on_trajectory = height == 10.0 && size == 4;
    const Prepared prepared = plate_over_coarse_plain(size, height, on_trajectory);
    for (const char* const hour : {"07:40", "09:00", "10:30", "15:20"}) {
        const Instant when = parse_instant(std::string("2026-03-20T") + hour + ":00Z");
        const Eigen::Vector3d sun = sun_direction(sun_position(prepared.world.site, when));
        const Shadow shadow = shadow_at(prepared, when);
        CAPTURE(size, height, hour, shadow.area, shadow.middle.transpose());
        CHECK(shadow.area == Approx(double(size * size)).epsilon(0.12));
        const Eigen::Vector2d expected = -height / sun.z() * sun.head<2>();
        CHECK((shadow.middle - expected).norm() < 0.35);
    }
}

TEST_CASE("the ground below what hovers is the same for another part of the month",
          "[scenes][shadow]") {
    const Prepared day = plate_over_coarse_plain(4, 10.0, false);
    const Prepared morning = plate_over_coarse_plain(4, 10.0, false, "duration_h = 6.0\n");
    REQUIRE(day.world.facets.size() == morning.world.facets.size());
    CHECK(day.world.facets.vertex == morning.world.facets.vertex);
    // What stands on the ground has the square round it alone.
    const Prepared lies = plate_over_coarse_plain(4, 0.01, false);
    CHECK(lies.world.ground_facets < day.world.ground_facets);
}
