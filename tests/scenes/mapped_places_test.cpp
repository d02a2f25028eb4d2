#include <GeographicLib/Geocentric.hpp>
#include <GeographicLib/LocalCartesian.hpp>
#include <GeographicLib/UTMUPS.hpp>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include "materials/base/error.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "scenes/job/world/elevation.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/geoid.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/small_scene.hpp"

// Places by latitude and longitude, or in the coordinates of a map, and heights above the sea and
// the ellipsoid: where they come to stand, by GeographicLib, from which the program takes neither
// its UTM (PROJ's) nor its way from file to frame.

using namespace diurna;
namespace fs = std::filesystem;

namespace {

const GeographicLib::Geocentric& earth = GeographicLib::Geocentric::WGS84();

std::string scene_with(const std::string& more) {
    std::string text = small_scene();
    text.erase(text.find("[[observer]]"));
    return text + more;
}

const std::string camera = R"(horizontal_fov_deg = 24.0
width = 64
height = 48
bands = ["8-12"]
)";

std::string eye(const std::string& keys) {
    return "[[observer]]\nname = \"eye\"\n" + keys + camera;
}

Prepared prepared(const std::string& text, const std::string& csv = "") {
    const ScratchFolder folder("mapped_places");
    write_text(folder.path / "scene.toml", text);
    if (!csv.empty()) write_text(folder.path / "lot.csv", csv);
    return prepare(read_scene(folder.path / "scene.toml"));
}

std::string mistakes_of(const std::string& text, const std::string& csv = "") {
    std::string all;
    try {
        prepared(text, csv);
    } catch (const InputError& error) {
        for (const Mistake& mistake : error.mistakes()) all += mistake.line() + "\n";
    }
    return all;
}

/// East, north, up [m] of a geodetic place in the frame of a site.
Eigen::Vector3d in_frame(const Site& site, double latitude, double longitude, double height) {
    const GeographicLib::LocalCartesian frame(site.latitude_deg, site.longitude_deg, site.height,
                                              earth);
    Eigen::Vector3d at;
    frame.Forward(latitude, longitude, height, at.x(), at.y(), at.z());
    return at;
}

struct Map {
    double easting, northing;
};
Map utm(double latitude, double longitude) {
    int zone = 0;
    bool north = true;
    Map map{};
    GeographicLib::UTMUPS::Forward(latitude, longitude, zone, north, map.easting, map.northing, 16);
    return map;
}

constexpr double latitude = 36.335, longitude = -84.180;  // 2.7 km from the site, on a slope

}  // namespace

TEST_CASE("an observer is above its latitude and longitude", "[scenes][places][by_comparison]") {
    const std::string at = "place = [36.335, -84.180]\nlook_at_place = [36.32, -84.203333]\n";
    const Prepared low = prepared(scene_with(eye(at + "height_above_ground_m = 1.0\n")));
    const Prepared high = prepared(scene_with(eye(at + "height_above_ground_m = 3000.0\n")));
    const Site& site = low.world.site;
    const Dem dem = elevation_of(low.scene);
    const double ground = height_at(dem, latitude, longitude);
    REQUIRE(std::isfinite(ground));
    const Eigen::Vector3d below = in_frame(site, latitude, longitude, ground + 1.0);
    const Eigen::Vector3d above = in_frame(site, latitude, longitude, ground + 3000.0);
    CHECK((low.sequences[0].at(0).position - below).norm() < 2e-3);
    // The vertical leans: 3 km above the place it is 1.2 m further out, where the ground below the
    // eye, to which its height is counted, is another by the slope.
    CHECK((above - below).head<2>().norm() > 1.0);
    CHECK((high.sequences[0].at(0).position - above).head<2>().norm() < 2e-3);
    CHECK(high.sequences[0].at(0).position.z() == Approx(above.z()).margin(1.0));
    // It looks at the site: the hangar stands beside, so the place itself is given by the angles.
    const Eigen::Vector3d to = -low.sequences[0].at(0).position;
    CHECK(low.sequences[0].at(0).azimuth_deg ==
          Approx(std::atan2(to.x(), to.y()) * 180.0 / M_PI + 360.0).margin(0.01));
}

TEST_CASE("a map's coordinates and latitude and longitude are one place",
          "[scenes][places][by_comparison]") {
    const Map map = utm(latitude, longitude);
    const std::string height = "height_above_ground_m = 40.0\nlook_at_m = [0.0, 0.0]\n";
    const auto position = [&](const std::string& keys) {
        return prepared(scene_with(eye(keys + height))).sequences[0].at(0).position;
    };
    const Eigen::Vector3d plain = position("place = [36.335, -84.180]\n");
    const std::string numbers =
        "place = [" + std::to_string(map.easting) + ", " + std::to_string(map.northing) + "]\n";
    CHECK((position(numbers + "place_crs = \"EPSG:32616\"\n") - plain).norm() < 2e-3);
    CHECK((position("place = [36.335, -84.180]\nplace_crs = \"EPSG:4326\"\n") - plain).norm() <
          1e-6);
    // For the whole file, in [site]; a table's own comes first.
    const std::string site = "longitude_deg = -84.203333\n";
    const std::string utm_file =
        with(scene_with(eye(numbers + height)), site, site + "place_crs = \"EPSG:32616\"\n");
    CHECK((prepared(utm_file).sequences[0].at(0).position - plain).norm() < 2e-3);
    const std::string both =
        with(scene_with(eye("place = [36.335, -84.180]\nplace_crs = \"EPSG:4326\"\n" + height)),
             site, site + "place_crs = \"EPSG:32616\"\n");
    CHECK((prepared(both).sequences[0].at(0).position - plain).norm() < 1e-6);
}

TEST_CASE("ground, buildings, objects and trajectories have mapped places, too",
          "[scenes][places]") {
    const std::string things = R"([[ground]]
name = "pad"
material = "concrete"
rectangle = [36.335, -84.180, 40.0, 20.0, 30.0]
largest_edge_m = 10.0
[[ground]]
name = "field"
ring = [[36.330, -84.190], [36.330, -84.188], [36.332, -84.188]]
[[building]]
name = "shed"
place = [36.325, -84.195]
width_m = 10.0
depth_m = 8.0
height_m = 4.0
wall = "concrete_wall"
[[object]]
name = "car"
model = "truck"
detail = "low"
place = [36.328, -84.2]
[[object]]
name = "lot"
model = "truck"
detail = "low"
copies_file = "lot.csv"
[[trajectory]]
name = "way"
waypoints = [[36.32, -84.2, 700.0], [36.33, -84.2, 800.0]]
speed_m_s = 50.0
heights = "sea"
)" + eye("trajectory = \"way\"\nmount_deg = [0.0, -20.0, 0.0]\nframe_every_s = 5.0\n");
    const Prepared built = prepared(scene_with(things),
                                    "latitude_deg,longitude_deg,heading_deg\n"
                                    "36.3285,-84.2,0\n36.329,-84.2,90\n");
    const Scene& scene = built.scene;
    const Site& site = built.world.site;
    const Dem dem = elevation_of(scene);
    const auto on_ground = [&](double north, double east) {
        return Eigen::Vector2d(in_frame(site, north, east, height_at(dem, north, east)).head<2>());
    };
    const auto middle = [](const std::vector<Eigen::Vector2d>& ring) {
        Eigen::Vector2d sum(0.0, 0.0);
        for (const Eigen::Vector2d& p : ring) sum += p / double(ring.size());
        return sum;
    };
    constexpr double near = 2e-3;
    const auto& polygons = scene.terrain.polygons;
    CHECK((middle(polygons.at(1).ring) - on_ground(36.335, -84.180)).norm() < near);
    CHECK((polygons[1].ring[1] - polygons[1].ring[0]).norm() == Approx(20.0));
    CHECK((polygons.at(2).ring.at(2) - on_ground(36.332, -84.188)).norm() < near);
    CHECK((scene.terrain.buildings.at(1).place - on_ground(36.325, -84.195)).norm() < near);
    CHECK((scene.terrain.objects.at(0).place - on_ground(36.328, -84.2)).norm() < near);
    CHECK((scene.terrain.objects.at(2).place - on_ground(36.329, -84.2)).norm() < near);
    // 50 m/s for 5 s along a way whose ends GeographicLib puts 1109.9 m and 100 m apart.
    const double geoid = site.height - built.world.sea_level_height;
    const Eigen::Vector3d from = in_frame(site, 36.32, -84.2, 700.0 + geoid);
    const Eigen::Vector3d to = in_frame(site, 36.33, -84.2, 800.0 + geoid);
    const Eigen::Vector3d gone =
        built.sequences[0].at(1).position - built.sequences[0].at(0).position;
    CHECK((built.sequences[0].at(0).position - from).norm() < 5e-3);
    CHECK(gone.norm() == Approx(250.0).margin(0.1));
    CHECK((gone.normalized() - (to - from).normalized()).norm() < 1e-3);
}

TEST_CASE("heights above the sea and the ellipsoid part by the geoid",
          "[scenes][places][by_comparison]") {
    // EGM96's geoid is 31 m below the ellipsoid there; tests/terrain has it at NGA's own places.
    const std::string at = "place = [36.335, -84.180]\nlook_at_m = [0.0, 0.0]\n";
    const auto built = [&](const std::string& keys) {
        return prepared(with(scene_with(eye(at + keys)), "radius_m = 4000.0\n",
                             "radius_m = 4000.0\nvertical_datum = \"egm96\"\n"));
    };
    const Prepared sea = built("height_above_sea_m = 1500.0\n");
    const Prepared gps = built("height_above_ellipsoid_m = 1500.0\n");
    const Eigen::Vector3d expected = in_frame(gps.world.site, latitude, longitude, 1500.0);
    CHECK((gps.sequences[0].at(0).position - expected).norm() < 2e-3);
    const double parts = sea.sequences[0].at(0).position.z() - gps.sequences[0].at(0).position.z();
    const Geodetic there{latitude, longitude, 0.0};  // the sea's height is that of the place
    CHECK(parts == Approx(geoid_heights({&there, 1}).front()).margin(1e-3));
    // A site's height is one of the raster's, above the sea there, too.
    const Prepared raised = prepared(
        with(with(scene_with(eye(at + "height_above_sea_m = 1500.0\n")), "radius_m = 4000.0\n",
                  "radius_m = 4000.0\nvertical_datum = \"egm96\"\n"),
             "longitude_deg = -84.203333\n", "longitude_deg = -84.203333\nheight_m = 500.0\n"));
    CHECK(raised.world.sea_level_height == Approx(500.0).margin(1e-6));
    CHECK((parts > -32.0 && parts < -30.0));
    // Without a datum the two are one, and that is reported.
    const Prepared untold = prepared(scene_with(eye(at + "height_above_ellipsoid_m = 1500.0\n")));
    const auto tells = [](const Prepared& p) {
        return std::any_of(p.notes.begin(), p.notes.end(), [](const std::string& note) {
            return note.find("\"eye\" use the same zero") != std::string::npos;
        });
    };
    CHECK(tells(untold));
    CHECK_FALSE(tells(gps));
}

TEST_CASE("eyes and objects stand beyond the raster at heights of their own", "[scenes][places]") {
    // The raster is a circle of 4 km; 8 km east and 40 m above the site's level. By the law of the
    // pinhole the site, level with the middle row, is below it by the angle that 340 m make.
    const std::string far_eye =
        eye("place_m = [8000.0, 0.0]\nheight_above_sea_m = 700.0\nlook_at_m = [0.0, 0.0]\n");
    const std::string balloon = R"([[object]]
name = "balloon"
model = "container"
detail = "low"
place_m = [6500.0, 0.0]
height_above_sea_m = 600.0
)";
    const ScratchFolder folder("beyond_raster");
    write_text(folder.path / "scene.toml", scene_with(balloon + far_eye));
    const Prepared built = prepare(read_scene(folder.path / "scene.toml"));
    const Observer& pose = built.sequences[0].at(0);
    const double geoid = built.world.site.height - built.world.sea_level_height;
    CHECK(to_geodetic(built.world.site, pose.position).height - geoid ==
          Approx(700.0).margin(5e-3));
    CHECK(pose.position.head<2>() == Eigen::Vector2d(8000.0, 0.0));
    CHECK(pose.azimuth_deg == Approx(270.0).margin(0.05));
    CHECK(pose.elevation_deg ==
          Approx(-std::atan(pose.position.z() / 8000.0) * 180.0 / M_PI).margin(0.02));
    // Above the ground there is none to stand on.
    CHECK_THAT(mistakes_of(scene_with(eye("place_m = [8000.0, 0.0]\nheight_above_ground_m = 30.0\n"
                                          "look_at_m = [0.0, 0.0]\n"))),
               Catch::Contains("scene.toml:") && Catch::Contains("place_m") &&
                   Catch::Contains("outside") && Catch::Contains("height_above_sea_m"));
}

TEST_CASE("invalid and implausible places are reported", "[scenes][places][input]") {
    const std::string height = "height_above_ground_m = 40.0\nlook_at_m = [0.0, 0.0]\n";
    const auto reported = [&](const std::string& keys) {
        return mistakes_of(scene_with(eye(keys + height)));
    };
    const auto one_line = [](const std::string& text) {
        return std::count(text.begin(), text.end(), '\n') == 1;
    };
    const std::string swapped = reported("place = [-84.18, 36.335]\n");
    CHECK_THAT(swapped, Catch::Contains("observer.place") && Catch::Contains("km from the site") &&
                            Catch::Contains("latitude comes before longitude"));
    CHECK(one_line(swapped));
    const std::string utm_untold = reported("place = [753000.0, 4024000.0]\n");
    CHECK_THAT(utm_untold,
               Catch::Contains("[latitude, longitude]") && Catch::Contains("place_crs"));
    CHECK(one_line(utm_untold));
    const std::string no_crs = reported("place = [36.335, -84.18]\nplace_crs = \"EPSG:99999\"\n");
    CHECK_THAT(no_crs, Catch::Contains("place_crs") && Catch::Contains("EPSG:99999"));
    CHECK(one_line(no_crs));
    CHECK_THAT(reported("place = [36.335, -84.18]\nplace_m = [0.0, 0.0]\n"),
               Catch::Contains("cannot be combined with place"));
    CHECK_THAT(reported("place_m = [0.0, 0.0]\nplace_crs = \"EPSG:32616\"\n"),
               Catch::Contains("place_crs") && Catch::Contains("unknown key"));
    CHECK_THAT(reported("place = [36.335, -84.18]\nheight_above_sea_m = 500.0\n"),
               Catch::Contains("found two heights"));
    for (const char* none :
         {"place = [36.335]\n", "place = [nan, -84.18]\n", "place = \"36.335, -84.18\"\n",
          "place = [753000.0, 4024000.0]\nplace_crs = 32616\n"}) {
        CAPTURE(none, reported(none));
        CHECK_THAT(reported(none), Catch::Contains("observer.place"));
        CHECK(one_line(reported(none)));
    }
    const std::string ground = "[[ground]]\nname = \"g\"\n";
    for (const char* border : {"ring = [[-84.2, 36.32], [-84.2, 36.33], [-84.19, 36.33]]\n",
                               "rectangle = [36.32, -84.2, 10.0, 20.0]\n",
                               "rectangle = [-84.2, 36.32, 10.0, 20.0, 0.0]\n"}) {
        const std::string all =
            mistakes_of(scene_with(ground + border + eye("place_m = [0.0, 0.0]\n" + height)));
        CAPTURE(border, all);
        CHECK(one_line(all));
    }
    CHECK_THAT(mistakes_of(scene_with(with(eye("place_m = [0.0, 0.0]\n" + height), "eye", "a/b") +
                                      with(eye("place_m = [9.0, 0.0]\n" + height), "eye", "a-b"))),
               Catch::Contains("\"a/b\" and \"a-b\" would have the same names"));
    CHECK_THAT(
        mistakes_of(scene_with(R"([[object]]
name = "lot"
model = "truck"
copies_file = "lot.csv"
)" + eye("place_m = [0.0, 0.0]\n" + height)),
                    "latitude_deg,longitude_deg,heading_deg\n36.32,-84.2,0\n136.32,-84.2,0\n"),
        Catch::Contains("lot.csv:3") && Catch::Contains("not a place"));
}
