#include "scenes/job/run/ground_to_horizon.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/stepper.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"
#include "scenes/job/world/border_ground.hpp"
#include "tests/support/slope_scene.hpp"

using namespace diurna;
using namespace slope_scene;

namespace {

/// 60 m above the west end of 118 m of ground, looking east.
std::string looking_east(double elevation_deg) {
    return fmt::format(
        "[[observer]]\nname = \"eye\"\nplace_m = [-55.0, 0.0]\nheight_above_ground_m = 60.0\n"
        "azimuth_deg = 90.0\nelevation_deg = {}\nhorizontal_fov_deg = 30.0\nwidth = 40\nheight = "
        "32\nsamples = 4\nbands = [\"8-12\"]\n",
        elevation_deg);
}

}  // namespace

TEST_CASE("the outline of a raster is its four sides, its ground what most of them have",
          "[scenes][beyond]") {
    const ScratchFolder folder("border");
    // A strip of asphalt along the whole of the eastern side.
    const Prepared scene = prepare(read_scene(
        written(folder.path, plane(0.0, 0.0),
                "[[ground]]\nname = \"road\"\nmaterial = \"asphalt\"\nrectangle_m = [54.0, 0.0, "
                "20.0, 200.0, 0.0]\n",
                looking_east(-20.0))));
    double length = 0.0;
    for (const BorderFacet& border : scene.world.border) length += double(border.length);
    CHECK(length == Approx(4.0 * 118.0).epsilon(0.01));
    const auto border = border_ground(scene.world, scene.world.facets);
    REQUIRE(border);
    CHECK(scene.scene.materials[border->material].name == "rock");
    CHECK(border->height == Approx(500.0).margin(0.1));
}

TEST_CASE("a picture continues beyond the raster as warm as its ground", "[scenes][beyond]") {
    const ScratchFolder folder("beyond");
    Stepper scene(read_scene(written(folder.path, plane(0.0, 0.0), "", looking_east(-20.0))));
    const Observer eye = scene.observer("eye");
    const Frame frame = scene.picture("eye", eye).frame;
    const auto& kelvin = frame["apparent_temperature.8-12"].pixel;
    const auto& material = frame["material"].pixel;
    double on = 0.0, beyond = 0.0;
    int on_count = 0, beyond_count = 0;
    // The row of the middle is 20 degrees below the level: all but the uppermost look down.
    for (std::size_t p = 40 * 4; p < kelvin.size(); ++p) {
        (material[p] >= 0.0F ? on : beyond) += double(kelvin[p]);
        ++(material[p] >= 0.0F ? on_count : beyond_count);
    }
    REQUIRE(on_count > 100);
    REQUIRE(beyond_count > 100);
    CHECK(beyond / beyond_count == Approx(on / on_count).margin(0.5));
    // Of 32 x 40 pixels those that meet no facet and look below the horizon, 0.25 degrees deep.
    const auto lines = as_lines(view_warnings(scene.prepared()));
    REQUIRE(lines.size() == 1);
    CAPTURE(lines[0]);
    const double share = std::stod(lines[0].substr(lines[0].find("eye: ") + 5));
    const auto without =
        double(std::count_if(material.begin(), material.end(), [](float m) { return m < 0.0F; }));
    CHECK(share == Approx(100.0 * without / double(material.size())).margin(6.0));
}

TEST_CASE("who looks at the raster alone depends on nothing beyond", "[scenes][beyond]") {
    const ScratchFolder folder("beyond_not");
    const Prepared scene = prepare(read_scene(written(folder.path, plane(0.0, 0.0), "")));
    const FarGround ground{.material = MaterialId{0}, .temperature = 300.0, .height_km = 0.5};
    View view;
    view.observer_height = 60.0;
    CHECK_FALSE(seen_beyond(view, ground, 0.5));  // no sky at all
    view.extent.sky_pixels = 10;
    view.extent.sky_zenith_deg = {40.0F, 90.2F};
    // The dip from 60 m is acos(R / (R + h)) = 0.249 degrees.
    CHECK_FALSE(seen_beyond(view, ground, 0.5));
    view.extent.sky_zenith_deg = {40.0F, 90.3F};
    CHECK(seen_beyond(view, ground, 0.5));
    CHECK(view_warnings(scene).empty());
}
