#include "scenes/world.hpp"

#include <catch2/catch.hpp>
#include <map>

#include "materials/error.hpp"
#include "scenes/plan.hpp"
#include "scenes/scene_file.hpp"
#include "terrain/sun.hpp"
#include "tests/small_scene.hpp"

using namespace diurna;

namespace {

struct Built {
    Scene scene;
    Dem dem;
    World world;
};

Built built(const std::string& text) {
    const ScratchFolder folder("world");
    write_text(folder.path / "scene.toml", text);
    Scene scene = read_scene(folder.path / "scene.toml");
    Dem dem = read_dem(scene.terrain.elevation, scene.terrain.reading);
    World world = build_world(scene, dem);
    return {std::move(scene), std::move(dem), std::move(world)};
}

}  // namespace

TEST_CASE("polygons and buildings keep their areas", "[scenes][world]") {
    const Built b = built(small_scene());
    std::map<std::string, double> plan_area, area;
    for (std::size_t f = 0; f < b.world.facets.size(); ++f) {
        const std::string& name =
            b.world.objects[static_cast<std::size_t>(b.world.facets.object[f])];
        plan_area[name] += b.world.facets.area[f] * b.world.facets.normal[f].z();
        area[name] += b.world.facets.area[f];
    }
    // The runway follows the relief: its plan is that of the rectangle.
    CHECK(plan_area["runway"] == Approx(1500.0 * 45.0).epsilon(2e-3));
    CHECK(plan_area["hangar"] == Approx(60.0 * 40.0).epsilon(1e-3));  // the roof
    CHECK(b.world.ground_check.worst_error <= 10.0 + 1e-3);
    CHECK(b.world.ground_check.uncovered_posts == 0);
    CHECK(b.world.ground_check.flipped_triangles == 0);
    // Walls stand in the ground, so they are taller than the building but not by much.
    const double walls = area["hangar"] - 60.0 * 40.0;
    CHECK(walls > 2.0 * (60.0 + 40.0) * 12.0);
    CHECK(walls < 2.0 * (60.0 + 40.0) * 40.0);
}

TEST_CASE("materials follow polygons first, then the rules", "[scenes][world]") {
    const Built b = built(small_scene());
    const MaterialId grass = b.scene.materials.find("grass"),
                     forest = b.scene.materials.find("forest"),
                     asphalt = b.scene.materials.find("asphalt");
    for (std::size_t f = 0; f < b.world.facets.size(); ++f) {
        const auto object = static_cast<std::size_t>(b.world.facets.object[f]);
        const double slope = std::acos(std::min(1.0f, b.world.facets.normal[f].z())) * 180.0 / M_PI;
        CAPTURE(f, slope, object);
        if (object == 1) CHECK(b.world.facets.material[f] == asphalt);
        if (object == 0 && slope < 6.9) CHECK(b.world.facets.material[f] == grass);
        if (object == 0 && slope > 7.1) CHECK(b.world.facets.material[f] == forest);
    }
}

TEST_CASE("the ground below a place is the raster's", "[scenes][world]") {
    const Built b = built(small_scene());
    const Eigen::Vector3d origin = ground_point(b.dem, b.world.site, {0.0, 0.0}, "test");
    CHECK(origin.norm() < 1e-3);  // the site's height was not given: it is the ground's
    CHECK_THROWS_AS(ground_point(b.dem, b.world.site, {1e5, 0.0}, "test"), InputError);
}

TEST_CASE("the plan counts what will be done", "[scenes][plan]") {
    const Built b = built(small_scene());
    const Plan plan = make_plan(b.scene, b.world);
    CHECK(plan.facets == b.world.facets.size());
    CHECK(plan.steps.size() == 24 * 3 + 1);
    CHECK(plan.frames.size() == 4);
    // Mid-July at 36.6 degrees north: 14 h 25 min of sun (USNO), so 43 or 44 steps of 20 minutes.
    CHECK(plan.sunlit_steps.size() >= 43);
    CHECK(plan.sunlit_steps.size() <= 45);
    for (const Instant instant : plan.sunlit_steps) {
        CHECK(sun_position(b.world.site, instant).elevation_deg > -0.9);
    }
    CHECK(plan.view_rays == 64 * 48 * 16);
    CHECK(describe(plan).find("asphalt") != std::string::npos);  // dry: no evaporation
}
