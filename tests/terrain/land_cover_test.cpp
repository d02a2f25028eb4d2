#include "terrain/raster/land_shapes.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "materials/base/error.hpp"
#include "terrain/ground/rings.hpp"
#include "terrain/objects/prism.hpp"
#include "terrain/raster/class_raster.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/shared_data.hpp"

using namespace diurna;

namespace {

const PrivateTempFolder private_temp_folder;

std::filesystem::path file(const std::string& name, const std::string& text) {
    const auto path = std::filesystem::temp_directory_path() / name;
    std::ofstream(path) << text;
    return path;
}

const std::string two_shapes = R"({"type":"FeatureCollection","features":[
{"type":"Feature","properties":{"use":"pond","h":null},"geometry":{"type":"Polygon","coordinates":
[[[8.0,46.0],[8.01,46.0],[8.01,46.01],[8.0,46.01],[8.0,46.0]],
 [[8.004,46.004],[8.006,46.004],[8.006,46.006],[8.004,46.004]]]}},
{"type":"Feature","properties":{"use":"road","h":4.5},"geometry":{"type":"MultiLineString",
"coordinates":[[[8.0,46.0],[8.02,46.0]],[[8.0,46.1],[8.0,46.2]]]}},
{"type":"Feature","properties":{"use":"tree","h":1},"geometry":{"type":"Point","coordinates":
[8.0,46.0]}}]})";

double area(const std::vector<Eigen::Vector2d>& ring) {
    double twice = 0.0;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        twice += ring[j].x() * ring[i].y() - ring[i].x() * ring[j].y();
    }
    return 0.5 * std::abs(twice);
}

}  // namespace

TEST_CASE("shapes come with class, height, holes and parts", "[terrain][land_cover]") {
    const auto shapes = read_shapes(file("shapes.geojson", two_shapes), "use", "h");
    REQUIRE(shapes.size() == 3);
    CHECK(shapes[0].kind == "pond");
    CHECK(shapes[0].ring.size() == 4);
    REQUIRE(shapes[0].hole.size() == 1);
    CHECK(shapes[0].hole[0].size() == 3);
    CHECK(std::isnan(shapes[0].height));
    CHECK(shapes[1].line);
    CHECK(shapes[1].height == 4.5);
    CHECK(shapes[2].ring[1].latitude_deg == 46.2);
}

TEST_CASE("what holds no shapes is refused in one line", "[terrain][land_cover][stress]") {
    const auto refusal = [](const std::filesystem::path& path, const std::string& field) {
        try {
            read_shapes(path, field);
        } catch (const InputError& error) {
            const std::string line = error.what();
            CHECK(line.find('\n') == std::string::npos);
            return line;
        }
        return std::string("accepted");
    };
    const auto good = file("shapes.geojson", two_shapes);
    CHECK(refusal(good, "user").find("use") != std::string::npos);
    CHECK(refusal(good.parent_path() / "none.gpkg", "").find("the file does not exist") !=
          std::string::npos);
    CHECK(refusal(file("broken.geojson", "{\"type\":"), "").find("cannot be read") !=
          std::string::npos);
    CHECK(refusal(file("not.shp", "hello"), "").find("cannot be read") != std::string::npos);
}

TEST_CASE("a ribbon is as wide as its line says", "[terrain][land_cover]") {
    const std::vector<Eigen::Vector2d> straight{{0, 0}, {100, 0}};
    CHECK(area(ribbon(straight, 8.0)) == Approx(800.0));
    const std::vector<Eigen::Vector2d> bent{{0, 0}, {100, 0}, {100, 100}};
    CHECK(area(ribbon(bent, 8.0)) == Approx(1600.0));  // what a mitre adds outside lacks inside
    CHECK(ribbon(std::vector<Eigen::Vector2d>{{1, 1}, {1, 1}}, 8.0).empty());
}

TEST_CASE("walls and roof of any plan have its areas", "[terrain][object]") {
    // An L: 20 × 10 with an 8 × 6 corner missing; perimeter that of the rectangle.
    const std::vector<Eigen::Vector2d> plan{{0, 0}, {20, 0}, {20, 4}, {12, 4}, {12, 10}, {0, 10}};
    for (const bool turned : {false, true}) {
        std::vector<Eigen::Vector2d> ring = plan;
        if (turned) std::reverse(ring.begin(), ring.end());
        const ObjectMesh mesh = prism({.ring = ring,
                                       .bottom = -2.0,
                                       .top = 7.0,
                                       .wall = MaterialId{1},
                                       .roof = MaterialId{2}});
        double walls = 0.0, roof = 0.0, outward = 0.0;
        for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
            const auto& [a, b, c] = mesh.triangle[t];
            const Eigen::Vector3f across =
                (mesh.vertex[b] - mesh.vertex[a]).cross(mesh.vertex[c] - mesh.vertex[a]);
            (mesh.material[t] == MaterialId{2} ? roof : walls) += 0.5 * across.norm();
            if (mesh.material[t] == MaterialId{2}) CHECK(across.z() > 0.0f);
            outward += across.dot(mesh.vertex[a] - Eigen::Vector3f(0, 0, -2.0f)) / 6.0;
        }
        CHECK(roof == Approx(152.0));
        CHECK(walls == Approx(60.0 * 9.0));
        CHECK(outward == Approx(152.0 * 9.0));  // the volume over the open floor
    }
    CHECK_THROWS_AS(prism({.ring = {{0, 0}, {1, 1}}}), InputError);
    CHECK_THROWS_AS(prism({.ring = {{0, 0}, {10, 10}, {10, 0}, {0, 10}}}), InputError);
}

TEST_CASE("classes of another CRS and resolution lie where they should",
          "[terrain][land_cover][samples]") {
    const auto cover = shared_data("data/dem/landcover/clc2018_edinburgh_3857.tif");
    if (!cover) return;
    const ClassRaster raster = read_class_raster(*cover);
    CHECK(raster.columns == 311);
    CHECK(raster.rows == 196);
    // Edinburgh: Princes Street is urban fabric or commerce, the Firth of Forth off Leith is sea.
    const std::vector<Geodetic> places{{55.952, -3.196, 0}, {56.01, -3.15, 0}, {40.0, 0.0, 0}};
    const auto found = classes_at(raster, places);
    CAPTURE(found[0], found[1]);
    CHECK((found[0] >= 1 && found[0] <= 11));
    CHECK((found[1] >= 39 && found[1] <= 44));
    CHECK(found[2] == no_class);
}

TEST_CASE("a shapefile's footprints stand on their raster", "[terrain][land_cover][samples]") {
    const auto shapes_file = shared_data("data/dem/urban/goteborg_buildings.shp");
    const auto dem_file = shared_data("data/dem/urban/goteborg_DEM_1m.tif");
    if (!shapes_file || !dem_file) return;
    const auto shapes = read_shapes(*shapes_file);
    CHECK(shapes.size() >= 137);
    const Dem dem = read_dem(*dem_file, {.voids = VoidPolicy::fill});
    // The raster shows a part of the town; its surface model is higher than the ground wherever a
    // footprint stands on it.
    const auto surface_file = shared_data("data/dem/urban/goteborg_DSM_1m.tif");
    if (!surface_file) return;
    const Dem surface = read_dem(*surface_file, {.voids = VoidPolicy::fill});
    std::size_t inside = 0, standing = 0;
    for (const LandShape& shape : shapes) {
        Eigen::Vector2d middle = Eigen::Vector2d::Zero();
        const auto places = raster_places(dem, shape.ring);
        for (const auto& place : places) middle += place / double(places.size());
        const double rise = height_at(surface, middle) - height_at(dem, middle);
        if (std::isnan(rise)) continue;
        ++inside;
        standing += rise > 2.0;
    }
    CAPTURE(inside, standing);
    CHECK(inside > 20);
    CHECK(standing * 10 > inside * 7);
}
