#include "scenes/job/plan/followed_rays.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "render/rays/follow_rays.hpp"
#include "render/view/cast_view.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/picture_samples.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "tests/support/crate.hpp"
#include "tests/support/small_scene.hpp"

// The rays that a plan counts for water, mirrors and panes are those that a picture follows.

using namespace diurna;

namespace {

Prepared scene_of(const std::string& tables) {
    const ScratchFolder folder("followed");
    write_text(folder.path / "crate.obj", crate_mesh);
    std::string text = with(small_scene(), "radius_m = 4000.0", "radius_m = 800.0");
    text = with(text, "place_m = [2000.0, 1100.0]", "place_m = [300.0, -60.0]");
    text = with(text, "height_above_ground_m = 450.0", "height_above_ground_m = 25.0");
    text = with(text, "look_at_m = [0.0, 0.0]", "look_at_m = [240.0, -60.0]");
    text = with(text, "front = \"glass\"\n", "");
    write_text(folder.path / "scene.toml", text + tables);
    return prepare(read_scene(folder.path / "scene.toml"));
}

std::string crate_of(const std::string& material) {
    return with(crate_object, "painted_sheet", material) + "place_m = [240.0, -60.0]\n";
}

constexpr const char* pond = R"([[ground]]
name = "pond"
material = "water"
rectangle_m = [250.0, -60.0, 12.0, 20.0, 0.0]
largest_edge_m = 5.0
)";
constexpr const char* pane = R"([material.pane]
like = "glass"
see_through = true
back = { kind = "exposed", emissivity = 0.84, albedo = 0.1 }
)";

FollowedOptions options_of(const Prepared& prepared) {
    const ObserverInput& observer = prepared.scene.observers[0];
    return {.samples = observer.samples, .by_need = adaptive_secondary(prepared.scene, observer)};
}

FollowedRays planned(const Prepared& prepared) {
    return followed_rays(prepared.scene, prepared.world, prepared.rays,
                         prepared.sequences[0].pose[0], options_of(prepared));
}

/// Of the whole picture, with facets that are all as warm.
FollowedRays in_picture(const Prepared& prepared) {
    const Observer& pose = prepared.sequences[0].pose[0];
    const FacetSet& surfaces = prepared.world.surfaces();
    const FollowedOptions options = options_of(prepared);
    const ViewOptions sampling{.samples = options.samples, .seed = prepared.scene.seed};
    View view = cast_view(prepared.rays, surfaces, pose, sampling);
    const Appearance look{.facet = std::vector<float>(surfaces.size(), 298.0f)};
    const SecondarySampling by_need{*options.by_need, {&look, 1}};
    const PlumeScene no_plumes({});
    const SecondaryRays found = follow_rays(view,
                                            {.rays = prepared.rays,
                                             .facets = surfaces,
                                             .materials = prepared.scene.materials,
                                             .plumes = no_plumes,
                                             .wind_speed = options.wind_speed},
                                            pose, sampling, &by_need);
    return {.pixels = double(found.pixel.size()),
            .rays = double(found.rays),
            .secondary = double(found.secondary.size())};
}

}  // namespace

TEST_CASE("a plan counts the rays that a picture follows off water and through panes",
          "[scenes][plan][followed_rays]") {
    const std::string tables = GENERATE(std::string(pond) + crate_of("painted_sheet"),
                                        pane + crate_of("pane"), crate_of("aluminium_polished"));
    CAPTURE(tables);
    const Prepared prepared = scene_of(tables);
    const FollowedRays plan = planned(prepared), picture = in_picture(prepared);
    REQUIRE(picture.pixels > 20.0);
    CAPTURE(plan.pixels, picture.pixels, plan.rays, picture.rays, plan.secondary,
            picture.secondary);
    // Pixels at edges are whole ones in a picture.
    CHECK(plan.pixels > 0.6 * picture.pixels);
    CHECK(plan.pixels < 1.2 * picture.pixels);
    CHECK(plan.rays > 0.5 * picture.rays);
    CHECK(plan.rays < 1.6 * picture.rays);
    CHECK(plan.secondary > 0.5 * picture.secondary);
    CHECK(plan.secondary < 1.6 * picture.secondary);
}

TEST_CASE("a plan counts no followed rays where nothing sends any on",
          "[scenes][plan][followed_rays]") {
    const FollowedRays none = planned(scene_of(crate_of("concrete")));
    CHECK(none.pixels == 0.0);
    CHECK(none.rays == 0.0);
}
