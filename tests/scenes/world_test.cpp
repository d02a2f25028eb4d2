#include "scenes/job/world/build_world.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <utility>

#include "materials/base/error.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/plan.hpp"
#include "scenes/job/plan/plan_text.hpp"
#include "scenes/job/run/picture.hpp"
#include "scenes/job/world/ground_point.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"

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
    Scene scene = read_scene(folder.path / "scene.toml", {}, true);
    Dem dem = read_dem(scene.terrain.elevation.file, scene.terrain.elevation.reading);
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

// Where two plans overlap no line of the ground goes round each: their walls stand on the raster.
TEST_CASE("walls of buildings that overlap stand on the ground", "[scenes][world]") {
    std::string text = with(small_scene(), "tolerance_m = 10.0", "tolerance_m = 1.0");
    const std::string hangar =
        text.substr(text.find("[[building]]"), text.find("[weather]") - text.find("[[building]]"));
    // Over a corner of the hangar; across the middle of its front.
    const auto [place, width] =
        GENERATE(std::pair{"[83.0, -70.0]", "60.0"}, std::pair{"[70.7, -70.7]", "24.0"});
    CAPTURE(place);
    std::string annex = with(hangar, "\"hangar\"", "\"annex\"");
    annex = with(with(annex, "[53.0, -88.4]", place), "width_m = 60.0",
                 std::string("width_m = ") + width);
    text = with(text, "[weather]", annex + "[weather]");
    const Built b = built(text);
    std::map<std::string, double> lowest, highest;
    for (std::size_t f = b.world.ground_facets; f < b.world.facets.size(); ++f) {
        const std::string& name =
            b.world.objects[static_cast<std::size_t>(b.world.facets.object[f])];
        if (std::abs(b.world.facets.normal[f].z()) > 0.1f) continue;
        for (const std::uint32_t v : b.world.facets.corner[f]) {
            const Eigen::Vector3d p = b.world.facets.vertex[v].cast<double>();
            const double ground = ground_point(b.dem, b.world.site, p.head<2>(), "wall").z();
            const auto [at, is_new] = lowest.try_emplace(name, p.z() - ground);
            at->second = std::min(at->second, p.z() - ground);
            highest[name] = std::max(highest[name], p.z() - ground);
        }
    }
    for (const char* name : {"hangar", "annex"}) {
        CAPTURE(name);
        CHECK(std::abs(lowest.at(name)) < 0.05);  // skirts went 2 m and more below it
        CHECK(highest.at(name) > 11.0);
    }
}

TEST_CASE("a flat sheet on the ground is lifted off it, and reported", "[scenes][world]") {
    const ScratchFolder folder("sheet-on-ground");
    write_text(folder.path / "quad.obj", "v -2 0 2\nv 2 0 2\nv 2 0 -2\nv -2 0 -2\nf 1 2 3 4\n");
    const auto with_sheet = [&](const char* height) {
        return built(with(small_scene(), "[weather]",
                          "[[object]]\nname = \"sheet\"\nmesh = \"" +
                              (folder.path / "quad.obj").string() +
                              "\"\nplace_m = [300.0, 300.0]\nstands = \"upright\"\n"
                              "material = \"painted_steel\"\n" +
                              height + "[weather]"));
    };
    const auto up = [](const World& world) {
        double highest = -1e9;
        for (std::size_t f = world.ground_facets; f < world.facets.size(); ++f) {
            if (world.objects[static_cast<std::size_t>(world.facets.object[f])] != "sheet")
                continue;
            highest = std::max(highest, double{world.facets.centroid[f].z()});
        }
        return highest;
    };
    const Built on = with_sheet(""), above = with_sheet("height_above_ground_m = 1.0\n");
    REQUIRE(on.world.notes.size() == 1);
    CHECK_THAT(on.world.notes[0], Catch::Contains("\"sheet\": a flat sheet on the ground"));
    CHECK(above.world.notes.empty());
    CHECK(up(above.world) - up(on.world) == Approx(0.99).margin(1e-3));
}

TEST_CASE("ground that is nowhere on the raster is refused by its place", "[scenes][world]") {
    const std::string far =
        with(small_scene(), "[0.0, 0.0, 1500.0, 45.0, 45.0]", "[90000.0, 0.0, 1500.0, 45.0, 45.0]");
    try {
        built(far);
        FAIL("accepted");
    } catch (const InputError& error) {
        REQUIRE(error.mistakes().size() == 1);
        const std::string line = error.mistakes()[0].line();
        CAPTURE(line);
        CHECK(line.find("scene.toml:18:15: ground.rectangle_m") != std::string::npos);
        CHECK(line.find("ground \"runway\" is entirely outside the elevation data") !=
              std::string::npos);
        CHECK(line.find('\n') == std::string::npos);
    }
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
    const Plan plan = make_plan(b.scene, b.world, {});
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

TEST_CASE("detail where somebody looks, less elsewhere", "[scenes][world]") {
    const std::string fine = with(small_scene(), "tolerance_m = 10.0", "tolerance_m = 2.0");
    const Built even = built(fine);
    const Built seen =
        built(with(fine, "tolerance_m = 2.0", "tolerance_m = 2.0\ncoarsest_m = 40.0"));
    CHECK(seen.world.ground_facets < 0.7 * double(even.world.ground_facets));
    CHECK(seen.world.ground_check.uncovered_posts == 0);
    CHECK(seen.world.ground_check.flipped_triangles == 0);
    CHECK(seen.world.ground_check.worst_error <= 40.0);
    CHECK(even.world.ground_check.worst_error <= 2.0 + 1e-3);
}

TEST_CASE("roads, ponds and footprints come from files of their own", "[scenes][world]") {
    const ScratchFolder folder("shapes");
    // A square of half a kilometre with a hole, a road across it, a house with a height beside it.
    write_text(folder.path / "land.geojson", R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"use":"water"},"geometry":{"type":"Polygon","coordinates":
[[[-84.190,36.320],[-84.184,36.320],[-84.184,36.325],[-84.190,36.325],[-84.190,36.320]],
 [[-84.188,36.322],[-84.186,36.322],[-84.186,36.323],[-84.188,36.323],[-84.188,36.322]]]}},
{"type":"Feature","properties":{"use":"road"},"geometry":{"type":"LineString","coordinates":
[[-84.192,36.3225],[-84.182,36.3225]]}},
{"type":"Feature","properties":{"use":"unknown"},"geometry":{"type":"Polygon","coordinates":
[[[-84.2,36.31],[-84.199,36.31],[-84.199,36.311],[-84.2,36.31]]]}}]})");
    write_text(folder.path / "houses.geojson", R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"storeys_m":9.0},"geometry":{"type":"Polygon","coordinates":
[[[-84.1800,36.3200],[-84.1798,36.3200],[-84.1798,36.3202],[-84.1800,36.3202],[-84.1800,36.3200]]]}},
{"type":"Feature","properties":{"storeys_m":7.0},"geometry":{"type":"Polygon","coordinates":
[[[0.0,1.0],[0.1,1.0],[0.1,1.1],[0.0,1.0]]]}}]})");
    write_text(folder.path / "scene.toml", small_scene() + R"(
[[shapes]]
file = "land.geojson"
field = "use"
line_width_m = 20.0
[shapes.kinds]
water = "water"
road = "asphalt"
[[shapes]]
name = "houses"
file = "houses.geojson"
height_field = "storeys_m"
wall = "concrete_wall"
)");
    Scene scene = read_scene(folder.path / "scene.toml");
    const Dem dem = read_dem(scene.terrain.elevation.file, scene.terrain.elevation.reading);
    const World world = build_world(scene, dem);
    REQUIRE(world.objects.back() == "houses");
    const MaterialId water = scene.materials.find("water");
    double pond = 0.0, house = 0.0;
    for (std::size_t f = 0; f < world.facets.size(); ++f) {
        const double plan = double{world.facets.area[f]} * world.facets.normal[f].z();
        const Eigen::Vector3f& c = world.facets.centroid[f];
        if (world.facets.material[f] == water && c.x() > 1000.0f) pond += plan;
        if (static_cast<std::size_t>(world.facets.object[f]) + 1 == world.objects.size()) {
            house += plan;
        }
    }
    // Metres per degree at 36.32° N: 89 825 east, 110 968 north (WGS84). The road is 20 m wide and
    // runs through the hole for 180 of its 539 m.
    const double east = 89825.0, north = 110968.0;
    CHECK(pond == Approx(0.006 * east * 0.005 * north - 0.002 * east * 0.001 * north -
                         (0.006 - 0.002) * east * 20.0)
                      .epsilon(2e-3));
    CHECK(house == Approx(0.0002 * east * 0.0002 * north).epsilon(2e-3));
    CHECK(world.ground_check.worst_error <= scene.terrain.elevation.tolerance + 1e-3);
}

TEST_CASE("ground that was filled in is marked, facet by facet and in the picture",
          "[scenes][world][voids]") {
    Built b = built(with(small_scene(), "tolerance_m = 10.0", "tolerance_m = 0.0"));
    CHECK(b.world.filled.empty());
    const int row = b.dem.rows / 4, column = b.dem.columns / 4;
    b.dem.is_void.assign(b.dem.height.size(), 0);
    b.dem.is_void[std::size_t(row) * b.dem.columns + column] = 1;
    const World world = build_world(b.scene, b.dem);
    // The full grid: an inner post has six triangles, or four to eight where diagonals differ.
    CHECK(world.filled_facets >= 4);
    CHECK(world.filled_facets <= 8);
    REQUIRE(world.filled.size() == world.facets.size());
    View view;
    std::size_t marked = 0;
    for (std::size_t f = 0; f < world.facets.size(); ++f) {
        if (!world.filled[f]) continue;
        ++marked;
        view.centre = {FacetId(f), no_facet, FacetId(world.ground_facets)};
        const Eigen::Vector2d east_north = world.facets.centroid[f].head<2>().cast<double>();
        const auto place = raster_places(b.dem, world.site, {&east_north, 1}).front();
        CHECK((place - Eigen::Vector2d(column, row)).cwiseAbs().maxCoeff() < 1.0);
    }
    CHECK(marked == world.filled_facets);
    view.sky = {0.0f, 1.0f, 0.0f};
    CHECK(void_plane(view, world).pixel == std::vector<float>{1.0f, -1.0f, 0.0f});
}

TEST_CASE("a mesh of a file stands on the ground, on finer triangles", "[scenes][world][object]") {
    const ScratchFolder folder("object");
    // A slab 6 m long, 2 m wide and 2 m high; its lid is a part of its own.
    write_text(folder.path / "slab.obj",
               "v -1 0 -3\nv 1 0 -3\nv 1 0 3\nv -1 0 3\nv -1 2 -3\nv 1 2 -3\nv 1 2 3\nv -1 2 3\n"
               "g hull\nf 1 2 3 4\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\ng lid\nf 5 8 7 6\n");
    const std::string object =
        "\n[[object]]\nname = \"slab\"\nstands = \"upright\"\nmesh = \"" +
        (folder.path / "slab.obj").string() +
        "\"\nplace_m = [200.0, 200.0]\nheading_deg = 45.0\nmaterial = \"painted_steel\"\n"
        "[object.parts]\nlid = \"glass\"\n";
    const Built b = built(small_scene() + object);
    const MaterialId glass = b.scene.materials.find("glass"),
                     asphalt = b.scene.materials.find("asphalt");
    double lid = 0.0, all = 0.0, patch = 0.0, largest = 0.0;
    float lowest = 1e9f;
    for (std::size_t f = 0; f < b.world.facets.size(); ++f) {
        const std::string& name =
            b.world.objects[static_cast<std::size_t>(b.world.facets.object[f])];
        const double area = b.world.facets.area[f];
        if (name == "slab") {
            all += area;
            if (b.world.facets.material[f] == glass) lid += area;
            for (const auto corner : b.world.facets.corner[f]) {
                lowest = std::min(lowest, b.world.facets.vertex[corner].z());
            }
        } else if ((b.world.facets.centroid[f].head<2>() - Eigen::Vector2f(200, 200)).norm() < 5) {
            // It stands on the runway, which the finer ground stays.
            CHECK(name == "runway");
            CHECK(b.world.facets.material[f] == asphalt);
            patch += area;
            largest = std::max(largest, area);
        }
    }
    CHECK(lid == Approx(12.0).epsilon(1e-3));
    CHECK(all == Approx(2.0 * (12.0 + 12.0 + 4.0)).epsilon(1e-3));
    CHECK(patch == Approx(3.14159 * 25.0).epsilon(0.05));
    CHECK(largest < 0.6);  // edges of 7.2 m / 12
    const Eigen::Vector3d ground =
        ground_point(b.dem, b.world.site, Eigen::Vector2d(200.0, 200.0), "test");
    CHECK(lowest == Approx(ground.z()).margin(1e-3));
}

TEST_CASE("a mistake in an object's parts names what there is", "[scenes][world][object]") {
    const ScratchFolder folder("object-mistake");
    write_text(folder.path / "a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\ng hull\nf 1 2 3\n");
    const std::string object = "\n[[object]]\nname = \"a\"\nmesh = \"" +
                               (folder.path / "a.obj").string() +
                               "\"\nplace_m = [0.0, 0.0]\nmaterial = \"painted_steel\"\n"
                               "[object.parts]\nhul = \"glass\"\n";
    CHECK_THROWS_WITH(built(small_scene() + object),
                      Catch::Contains("object.parts.hul") && Catch::Contains("hull"));
}
