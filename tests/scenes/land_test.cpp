#include "scenes/job/world/land.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "render/picture/exr.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "scenes/job/world/build_world.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/geotiff.hpp"
#include "terrain/raster/read_dem.hpp"
#include "terrain/visibility/reciprocity.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "tests/support/built_land.hpp"
#include "tests/support/keys_of_page.hpp"
#include "tests/support/passed_over.hpp"
#include "tests/support/small_scene.hpp"

// From files on the ground to facets and pictures.

using namespace diurna;
using namespace diurna::testing::built_land;

namespace {

/// Plan area [m²] of each material.
std::map<std::string, double> plan_areas(const Built& b) {
    std::map<std::string, double> area;
    for (const std::string& name : b.scene.materials.names()) {
        const MaterialId material = b.scene.materials.find(name);
        for (std::size_t f = 0; f < b.world.facets.size(); ++f) {
            if (b.world.facets.material[f] != material) continue;
            area[name] += double{b.world.facets.area[f]} * b.world.facets.normal[f].z();
        }
    }
    return area;
}

const char* const fields = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"use":"water"},"geometry":{"type":"Polygon","coordinates":
[[[-84.190,36.320],[-84.184,36.320],[-84.184,36.325],[-84.190,36.325],[-84.190,36.320]]]}},
{"type":"Feature","properties":{"use":"soil"},"geometry":{"type":"Polygon","coordinates":
[[[-84.215,36.305],[-84.210,36.305],[-84.210,36.309],[-84.215,36.305]]]}}]})";

std::string shapes_table(const std::string& file) {
    return "[[shapes]]\nfile = \"" + file +
           "\"\nfield = \"use\"\n[shapes.kinds]\nwater = \"water\"\nsoil = \"bare_soil\"\n";
}

}  // namespace

TEST_CASE("the full grid is the ground where it is requested or fits", "[scenes][land][grid]") {
    const Built network = built(small_scene());
    const Built grid = built(with_terrain("mesh = \"grid\""));
    const Built fits = built(with_terrain("mesh = \"auto\""));
    const auto cells = std::size_t(grid.dem.columns - 1) * std::size_t(grid.dem.rows - 1);
    CHECK(grid.world.ground_facets > 2 * cells);
    CHECK(grid.world.ground_facets < 2 * cells + 4000);  // at the runway, and round the hangar
    CHECK(fits.world.ground_facets == grid.world.ground_facets);
    CHECK(network.world.ground_facets < cells);
    CHECK(grid.world.ground_check.worst_error < 1e-3);
    CHECK(grid.world.ground_check.uncovered_posts == 0);
    CHECK(plan_areas(grid).at("asphalt") == Approx(1500.0 * 45.0).epsilon(2e-3));
}

TEST_CASE("a class raster of another CRS covers the ground", "[scenes][land]") {
    // Cells of 100 m of Web Mercator about the site, class 1 west of its meridian, 2 east of it,
    // and a third that the table does not know in the north.
    const double middle_x = -84.203333 * M_PI / 180.0 * 6378137.0;
    const double middle_y = 6378137.0 * std::asinh(std::tan(36.32 * M_PI / 180.0));
    Dem place;
    place.source = "classes";
    place.columns = place.rows = 140;
    place.transform = {middle_x - 7000.0, 100.0, 0.0, middle_y + 7000.0, 0.0, -100.0};
    place.crs_wkt = "EPSG:3857";
    std::vector<float> classes;
    for (int row = 0; row < place.rows; ++row) {
        for (int column = 0; column < place.columns; ++column) {
            classes.push_back(row < 50 ? 7.0f : column < 70 ? 1.0f : 2.0f);
        }
    }
    write_geotiff(scratch.path / "classes.tif", place, {{"class", classes}});
    const Built b = built(small_scene() +
                          "[terrain.land_cover]\nfile = \"classes.tif\"\n"
                          "[terrain.land_cover.material]\n1 = \"sand\"\n2 = \"bare_soil\"\n");
    const MaterialId west = b.scene.materials.find("sand");
    const MaterialId east = b.scene.materials.find("bare_soil");
    std::size_t found[3] = {};
    for (std::size_t f = 0; f < b.world.ground_facets; ++f) {
        if (b.world.facets.object[f] != ObjectId{0}) continue;  // the runway
        const Eigen::Vector3f& c = b.world.facets.centroid[f];
        // Row 50 begins 2000 m north in Mercator, 2000 cos 36.32° on the ground.
        if (std::abs(c.y() - 2000.0 * std::cos(36.32 * M_PI / 180.0)) < 15.0) continue;
        if (std::abs(c.x()) < 5.0) continue;
        const bool north = c.y() > 2000.0 * std::cos(36.32 * M_PI / 180.0);
        const MaterialId material = b.world.facets.material[f];
        ++found[north ? 2 : c.x() > 0.0f];
        if (north) {
            CHECK((material != west && material != east));
        } else {
            CHECK(material == (c.x() > 0.0f ? east : west));
        }
    }
    for (const std::size_t count : found) CHECK(count > 50);
}

TEST_CASE("GeoJSON, Shapefile and GeoPackage give the same ground", "[scenes][land]") {
    write_text(scratch.path / "fields.geojson", fields);
    const auto areas = plan_areas(built(small_scene() + shapes_table("fields.geojson")));
    // Metres per degree at 36.32° N: 89 825 east, 110 968 north (WGS84).
    CHECK(areas.at("water") == Approx(0.006 * 89825.0 * 0.005 * 110968.0).epsilon(2e-3));
    CHECK(areas.at("bare_soil") == Approx(0.5 * 0.005 * 89834.0 * 0.004 * 110968.0).epsilon(3e-3));
    if (std::system("ogr2ogr --version > /dev/null 2>&1") != 0) {
        pass_over("no ogr2ogr to write the other formats");
        return;
    }
    for (const auto& [driver, name] :
         {std::pair{"ESRI Shapefile", "fields.shp"}, {"GPKG", "fields.gpkg"}}) {
        const std::string command = "ogr2ogr -f '" + std::string(driver) + "' -t_srs EPSG:32616 '" +
                                    (scratch.path / name).string() + "' '" +
                                    (scratch.path / "fields.geojson").string() + "' 2> /dev/null";
        REQUIRE(std::system(command.c_str()) == 0);
        const auto same = plan_areas(built(small_scene() + shapes_table(name)));
        CAPTURE(driver);
        CHECK(same.at("water") == Approx(areas.at("water")).epsilon(1e-5));
        CHECK(same.at("bare_soil") == Approx(areas.at("bare_soil")).epsilon(1e-5));
    }
}

TEST_CASE("heights follow the unit and the datum that the scene names", "[scenes][land]") {
    const Built plain = built(small_scene());
    const Built feet = built(with_terrain("height_unit = \"ft\""));
    CHECK(feet.world.site.height == Approx(0.3048 * plain.world.site.height).epsilon(1e-6));
    const Built raised = built(with_terrain("vertical_datum = \"egm96\""));
    // EGM96 lies 31 m below the ellipsoid in east Tennessee.
    const double geoid = raised.world.site.height - plain.world.site.height;
    CHECK(geoid == Approx(-31.0).margin(2.0));
    CHECK(raised.world.sea_level_height == Approx(plain.world.sea_level_height).margin(0.01));
    CHECK_THROWS_AS(scene_of(with_terrain("height_unit = \"furlong\"")), InputError);
    CHECK_THROWS_AS(scene_of(with_terrain("vertical_datum = \"mars\"")), InputError);
}

// The corners of 31 x 37 km of plain lie up to 45 m below the plane through its middle; a triangle
// from one to the other would be a chord 45 m below the plain.
TEST_CASE("a wide plain lies on the round earth, within the tolerance", "[scenes][land]") {
    Dem plain = read_dem(DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif");
    std::fill(plain.height.begin(), plain.height.end(), 300.0f);
    write_geotiff(scratch.path / "plain.tif", plain, {{"height", plain.height}});
    std::string text = with(small_scene(), "tolerance_m = 10.0", "tolerance_m = 2.0");
    text = with(text, std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/elevation.tif",
                (scratch.path / "plain.tif").string());
    const Built b = built(with(text, "radius_m = 4000.0\n", ""));
    double farthest = 0.0;
    for (std::size_t f = 0; f < b.world.ground_facets; ++f) {
        const Eigen::Vector3d middle = b.world.facets.centroid[f].cast<double>();
        farthest = std::max(farthest, middle.head<2>().norm());
        // A triangle's middle is where its chord is deepest; 0.5 % for the earth's ellipsoid.
        CHECK(std::abs(level_height(middle)) < 2.0 + 0.25);
    }
    CHECK(farthest > 12e3);
    CHECK(b.world.facets.size() < 20000);
}

TEST_CASE("a scene with refraction lifts its far ground", "[scenes][land]") {
    const Built plain = built(small_scene());
    const Built bent = built(with_terrain("refraction = 0.13"));
    // Heights decide which posts the mesh has: nearly all are in both.
    std::map<std::pair<long, long>, double> lifted;  // [cm] east, north
    const auto place = [](const Eigen::Vector3d& p) {
        return std::pair{std::lround(100.0 * p.x()), std::lround(100.0 * p.y())};
    };
    const auto ground = [](const World& world) {
        std::vector<Eigen::Vector3d> corners;
        for (std::size_t f = 0; f < world.ground_facets; ++f) {
            for (const std::uint32_t v : world.facets.corner[f]) {
                corners.push_back(world.facets.vertex[v].cast<double>());
            }
        }
        return corners;
    };
    for (const Eigen::Vector3d& b : ground(bent.world)) lifted[place(b)] = b.z();
    double furthest = 0.0;
    std::size_t both = 0;
    const std::vector<Eigen::Vector3d> corners = ground(plain.world);
    for (const Eigen::Vector3d& a : corners) {
        const auto found = lifted.find(place(a));
        if (found == lifted.end()) continue;
        ++both;
        const double distance = a.head<2>().norm();
        furthest = std::max(furthest, distance);
        CHECK(found->second - a.z() ==
              Approx(0.13 * distance * distance / (2.0 * 6371e3)).margin(2e-4));
    }
    CHECK(double(both) > 0.95 * double(corners.size()));
    CHECK(furthest > 4000.0);  // 0.16 m
}

TEST_CASE("voids of a file are marked in its picture", "[scenes][land][voids]") {
    Dem dem = read_dem(scene_of(small_scene()).terrain.elevation.file);
    const Eigen::Vector2d site =
        raster_places(dem, std::vector<Geodetic>{{36.32, -84.203333, 0.0}}).front();
    // A square hole of 7 posts, 600 m, half-way between site and observer.
    const int column = int(site.x()) + 7, row = int(site.y()) - 4;
    for (int r = row - 3; r <= row + 3; ++r) {
        for (int c = column - 3; c <= column + 3; ++c) {
            dem.height[std::size_t(r) * std::size_t(dem.columns) + std::size_t(c)] = std::nanf("");
        }
    }
    write_geotiff(scratch.path / "holed.tif", dem, {{"height", dem.height}});
    std::string text = with(small_scene(), scene_of(small_scene()).terrain.elevation.file.string(),
                            (scratch.path / "holed.tif").string());
    CHECK_THROWS_AS(prepare(scene_of(text)), InputError);  // refused unless reported to fill
    text = with(text, "tolerance_m = 10.0", "tolerance_m = 10.0\nvoids = \"fill\"");
    text = with(text, "frame_every_s = 21600.0", "frame_every_s = 86400.0");
    JobOptions options;
    options.out = scratch.path / "out";
    const JobReport report = run_job(scene_of(text), options);
    CHECK(report.frames_rendered >= 1);
    std::size_t marked = 0, ground = 0, sky = 0, pictures = 0;
    for (const std::string& file : report.files) {
        if (!file.ends_with(".exr")) continue;
        ++pictures;
        const Frame frame = read_exr(scratch.path / "out" / file);
        const auto plane = [&](const std::string& name) {
            const auto found = std::find_if(frame.planes.begin(), frame.planes.end(),
                                            [&](const Plane& p) { return p.name == name; });
            REQUIRE(found != frame.planes.end());
            return found->pixel;
        };
        const auto holes = plane("void"), facet = plane("facet");
        for (std::size_t p = 0; p < holes.size(); ++p) {
            if (facet[p] < 0.0f) {
                ++sky;
                CHECK(holes[p] == -1.0f);
            } else {
                ++(holes[p] == 1.0f ? marked : ground);
            }
        }
    }
    CHECK(pictures >= 1);
    CHECK(marked > 20);
    CHECK(ground > 2 * marked);
    CHECK(std::any_of(report.notes.begin(), report.notes.end(), [](const std::string& note) {
        return note.find("49 of") != std::string::npos;
    }));
}
