#include "terrain/ground/triangulate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "materials/base/error.hpp"
#include "terrain/facets.hpp"
#include "terrain/ground/ground_mesh.hpp"
#include "terrain/ground/level_of_detail.hpp"
#include "terrain/ground/tin_check.hpp"
#include "terrain/objects/mesh_check.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/shared_data.hpp"

using namespace diurna;

namespace {

constexpr float no_height = std::numeric_limits<float>::quiet_NaN();

/// Posts 100 m apart near 46° N 8° E in UTM 32.
Dem made_dem(int columns, int rows, const std::function<float(int, int)>& height) {
    Dem dem;
    dem.source = "made";
    dem.columns = columns;
    dem.rows = rows;
    dem.transform = {420e3, 100.0, 0.0, 5100e3, 0.0, -100.0};
    dem.crs_wkt = "EPSG:32632";
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) dem.height.push_back(height(r, c));
    }
    return dem;
}

Dem hills(int columns, int rows) {
    return made_dem(columns, rows, [](int r, int c) {
        return static_cast<float>(500 + 60 * std::sin(0.21 * c) * std::cos(0.13 * r) +
                                  9 * std::sin(1.7 * c + 0.9 * r));
    });
}

double seconds(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double signed_area(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
    return 0.5 * ((c.x() - a.x()) * (b.y() - a.y()) - (b.x() - a.x()) * (c.y() - a.y()));
}

}  // namespace

TEST_CASE("no post lies further from the network than the tolerance", "[terrain][tin]") {
    const double tolerance = GENERATE(0.0, 0.5, 3.0, 20.0);
    const Dem dem = hills(120, 90);
    const Tin tin = triangulate(dem, tolerance);
    const TinCheck check = check_tin(dem, tin);
    CHECK(check.worst_error <= tolerance + 1e-9);
    CHECK(check.uncovered_posts == 0);
    CHECK(check.flipped_triangles == 0);
    // Euler: a triangulated disc of v vertices, b on its border, has 2v - b - 2 triangles; here
    // the plan area says the same: all of the rectangle, once.
    double area = 0.0;
    for (const auto& [i, j, k] : tin.triangle) {
        const auto at = [&](std::uint32_t v) {
            return Eigen::Vector2d(tin.post[v][0], tin.post[v][1]);
        };
        area += signed_area(at(i), at(j), at(k));
    }
    CHECK(area == Approx(119.0 * 89.0).epsilon(1e-12));
}

TEST_CASE("a plane needs two triangles, whatever its slope", "[terrain][tin][by_degenerate]") {
    const Dem dem = made_dem(50, 70, [](int r, int c) { return 3.0f * r - 0.5f * c; });
    CHECK(triangulate(dem, 0.0).triangle.size() == 2);
    CHECK(check_tin(dem, triangulate(dem, 0.0)).worst_error < 1e-9);
}

TEST_CASE("voids stay holes and their rims are covered", "[terrain][tin]") {
    Dem dem = hills(80, 60);
    std::mt19937 random(3);
    for (int r = 20; r < 35; ++r) {
        for (int c = 10; c < 30 + r / 3; ++c) dem.height[std::size_t(r) * 80 + c] = no_height;
    }
    for (int i = 0; i < 60; ++i) dem.height[random() % dem.height.size()] = no_height;
    for (int c = 0; c < 80; ++c) dem.height[std::size_t(59) * 80 + c] = no_height;
    const double tolerance = GENERATE(0.0, 5.0, 100.0);
    const TinCheck check = check_tin(dem, triangulate(dem, tolerance));
    CHECK(check.worst_error <= tolerance + 1e-9);  // a void under a triangle counts as 1e30
    CHECK(check.uncovered_posts == 0);
    CHECK(check.flipped_triangles == 0);
}

TEST_CASE("the check finds a network that is wrong", "[terrain][tin]") {
    const Dem dem = made_dem(3, 3, [](int r, int c) { return r == 1 && c == 1 ? 10.0f : 0.0f; });
    Tin tin{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {{0, 2, 1}, {0, 3, 2}}};
    CHECK(check_tin(dem, tin).worst_error == 10.0);
    std::swap(tin.triangle[0][0], tin.triangle[0][1]);
    CHECK(check_tin(dem, tin).flipped_triangles == 1);
    tin.triangle.pop_back();
    CHECK(check_tin(dem, tin).uncovered_posts == 9);
}

TEST_CASE("the same raster gives the same network", "[terrain][tin][invariance][by_replication]") {
    const Dem dem = hills(100, 100);
    const Tin a = triangulate(dem, 1.0), b = triangulate(dem, 1.0);
    CHECK(a.post == b.post);
    CHECK(a.triangle == b.triangle);
}

TEST_CASE("footprints have exactly their own triangles", "[terrain][ground]") {
    const Dem dem = hills(60, 60);
    const double tolerance = GENERATE(0.0, 2.0, 10.0);
    // A runway narrower than a post spacing, across the lattice; a field over it; one cut by the
    // raster's edge.
    const std::vector<Footprint> footprints{
        {{{10.3, 12.1}, {10.6, 11.8}, {40.6, 41.8}, {40.3, 42.1}}, 20.0},
        {{{18.0, 30.0}, {35.5, 22.5}, {36.0, 36.0}}, 150.0},
        {{{50.0, 50.0}, {80.0, 50.0}, {80.0, 55.0}, {50.0, 55.0}}, 1000.0}};
    const GroundMesh mesh = ground_mesh(dem, tolerance, footprints);
    const TinCheck check = check_ground_mesh(dem, mesh);
    CHECK(check.worst_error <= tolerance + 1e-9);
    CHECK(check.uncovered_posts == 0);
    CHECK(check.flipped_triangles == 0);

    double area[4] = {};
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        const auto& [i, j, k] = mesh.triangle[t];
        const Eigen::Vector2d &a = mesh.place[i], &b = mesh.place[j], &c = mesh.place[k];
        area[mesh.footprint[t] + 1] += signed_area(a, b, c);
    }
    CHECK(area[0] + area[1] + area[2] + area[3] == Approx(59.0 * 59.0).epsilon(1e-9));
    // Shoelace areas: the runway less what the field takes of it, 0.3√2 wide, from where it enters
    // to where it leaves; found here by clipping on a fine lattice instead.
    const auto shoelace = [](const std::vector<Eigen::Vector2d>& ring) {
        double sum = 0.0;
        for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
            sum += ring[j].x() * ring[i].y() - ring[i].x() * ring[j].y();
        }
        return std::abs(0.5 * sum);
    };
    CHECK(area[2] == Approx(shoelace(footprints[1].ring)).epsilon(1e-6));
    CHECK(area[3] == Approx(9.0 * 5.0).epsilon(1e-6));
    CHECK(area[1] < shoelace(footprints[0].ring));
    CHECK(area[1] > 0.5 * shoelace(footprints[0].ring));

    // Alone, the runway has short edges: 20 m along the ring, a lattice within.
    const GroundMesh alone = ground_mesh(dem, tolerance, std::span(footprints).first(1));
    for (std::size_t t = 0; t < alone.triangle.size(); ++t) {
        if (alone.footprint[t] != 0) continue;
        for (int k = 0; k < 3; ++k) {
            const auto i = alone.triangle[t][k], j = alone.triangle[t][(k + 1) % 3];
            CHECK((alone.place[i] - alone.place[j]).norm() * 100.0 < 1.5 * 20.0);
        }
    }
}

TEST_CASE("without overlap a footprint's triangles fill its ring", "[terrain][ground]") {
    const Dem dem = hills(40, 40);
    std::vector<Eigen::Vector2d> ring;  // a star of 9 points, concave
    for (int i = 0; i < 18; ++i) {
        const double around = i * std::numbers::pi / 9, radius = i % 2 ? 4.0 : 11.0;
        ring.emplace_back(20.2 + radius * std::cos(around), 19.7 + radius * std::sin(around));
    }
    const GroundMesh mesh = ground_mesh(dem, 4.0, std::vector{Footprint{ring, 60.0}});
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        const auto& [i, j, k] = mesh.triangle[t];
        if (mesh.footprint[t] == 0) {
            area += signed_area(mesh.place[i], mesh.place[j], mesh.place[k]);
        }
    }
    // Nine kites: 9 · R r sin(π/9). The ring may move 0.005 posts onto a post.
    CHECK(area == Approx(9.0 * 11.0 * 4.0 * std::sin(std::numbers::pi / 9)).epsilon(2e-3));
    CHECK(check_ground_mesh(dem, mesh).worst_error <= 4.0 + 1e-9);
}

TEST_CASE("footprints beside and over voids leave the guarantee whole",
          "[terrain][ground][stress]") {
    Dem dem = hills(50, 50);
    for (int r = 20; r < 30; ++r) {
        for (int c = 20; c < 30; ++c) dem.height[std::size_t(r) * 50 + c] = no_height;
    }
    const std::vector<Footprint> footprints{
        {{{15.5, 15.5}, {33.3, 16.1}, {34.0, 33.0}, {16.0, 32.0}}, 30.0},
        {{{18.9, 20.3}, {19.2, 20.3}, {19.2, 27.0}, {18.9, 27.0}}, 10.0},
        {{{5.0, 25.1}, {45.0, 25.1}, {45.0, 25.4}, {5.0, 25.4}}, 50.0}};
    const GroundMesh mesh = ground_mesh(dem, 3.0, footprints);
    const TinCheck check = check_ground_mesh(dem, mesh);
    CHECK(check.worst_error <= 3.0 + 1e-9);
    CHECK(check.uncovered_posts == 0);
    CHECK(check.flipped_triangles == 0);
    for (const float h : mesh.height) CHECK(std::isfinite(h));
}

TEST_CASE("an invalid footprint is refused", "[terrain][ground][stress]") {
    const Dem dem = hills(10, 10);
    Footprint footprint{{{1, 1}, {5, 1}, {5, 5}}, 50.0};
    SECTION("two corners") { footprint.ring.pop_back(); }
    SECTION("not a number") { footprint.ring[0].x() = std::nan(""); }
    SECTION("outside") {
        for (auto& p : footprint.ring) p.x() += 100.0;
    }
    SECTION("no edge") { footprint.largest_edge = 0.0; }
    CHECK_THROWS_AS(ground_mesh(dem, 1.0, std::vector{footprint}), InputError);
}

// Triangle counts: greedy insertion as measured elsewhere, ± 5 %; 0 where voids were not treated
// alike.
TEST_CASE("real terrain to a tolerance, as many triangles as known", "[terrain][tin][samples]") {
    struct Case {
        std::string name;
        double tolerance;
        double triangles;
    };
    const Case c = GENERATE(values<Case>({{"tuolumne_albers_30m.tif", 10.0, 90.9e3},
                                          {"tuolumne_albers_30m.tif", 2.0, 638e3},
                                          {"tuolumne_albers_30m.tif", 1.0, 1.117e6},
                                          {"bigtujunga.tif", 10.0, 106e3},
                                          {"bigtujunga.tif", 1.0, 911e3},
                                          {"isce_winnipeg_dem.tif", 1.0, 127e3},
                                          {"mt_everest_90m.tif", 20.0, 0},
                                          {"N43E007.hgt.zip", 10.0, 0},
                                          {"SainteHelens.dem", 5.0, 0},
                                          {"craterlake-elev-16bit-30m.tif", 5.0, 0}}));
    const auto file = shared_data("data/dem/" + c.name);
    if (!file) return;
    const Dem dem = read_dem(*file, {.voids = VoidPolicy::leave});
    Tin tin;
    const double time = seconds([&] { tin = triangulate(dem, c.tolerance); });
    const TinCheck check = check_tin(dem, tin);
    CAPTURE(c.name, c.tolerance, tin.triangle.size());
    CHECK(check.worst_error <= c.tolerance + 1e-9);
    CHECK(check.uncovered_posts == 0);
    CHECK(check.flipped_triangles == 0);
    if (c.triangles > 0) CHECK(double(tin.triangle.size()) == Approx(c.triangles).epsilon(0.05));
    WARN(c.name << " " << c.tolerance << " m: " << tin.triangle.size() << " triangles, rms "
                << check.rms_error << " m, " << time << " s");
}

TEST_CASE("any elevation file becomes facets in a local frame", "[terrain][samples]") {
    const auto name = GENERATE("bigtujunga.tif", "N43E007.hgt.zip", "SainteHelens.dem",
                               "craterlake-elev-16bit-30m.tif", "isce_dem_south_pole.tif");
    const auto file = shared_data(std::string("data/dem/") + name);
    if (!file) return;
    CAPTURE(name);
    const Dem dem = read_dem(*file, {.voids = VoidPolicy::leave});
    const GroundMesh mesh = ground_mesh(dem, 5.0);
    const Geodetic centre = dem_centre(dem);
    const Site site{centre.latitude_deg, centre.longitude_deg, centre.height};
    auto vertex = local_vertices(dem, site, mesh.place, mesh.height);
    double reach = 0.0;
    for (const auto& v : vertex) reach = std::max(reach, v.cwiseAbs().maxCoeff());
    if (reach > 100e3) {  // the polar raster is 420 km wide: more than a scene
        for (auto& v : vertex) v *= 99e3 / reach;
    }
    FacetSet facets;
    append_facets(facets, vertex, mesh.triangle, std::vector<MaterialId>(mesh.triangle.size()),
                  ObjectId{0});
    CHECK(facets.size() == mesh.triangle.size());
    for (const auto& normal : facets.normal) CHECK(normal.z() > 0.0f);
    const MeshCheck check = check_mesh(facets.vertex, facets.corner);
    CHECK(check.rejected_triangles == 0);
}

TEST_CASE("detail follows the viewpoint, without cracks and within each post's tolerance",
          "[terrain][triangulate][lod]") {
    const Dem dem = read_dem(DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif");
    const Viewpoint eye{.place = {200.0, 170.0}, .height = 100.0, .angle = 1e-3};
    const auto slack = level_of_detail(dem, {&eye, 1}, 1.0, 20.0);
    CHECK(*std::min_element(slack.begin(), slack.end()) == 1.0f);
    CHECK(slack.front() > 10.0f);
    const Footprint field{.ring = {{190, 160}, {210, 160}, {210, 180}, {190, 180}},
                          .largest_edge = 200.0};
    const GroundMesh mesh = ground_mesh(dem, 1.0, {&field, 1}, slack);
    const GroundMesh even = ground_mesh(dem, 1.0, {&field, 1});
    CHECK(mesh.triangle.size() < even.triangle.size() / 3);
    const TinCheck found = check_ground_mesh(dem, mesh);
    CHECK(found.uncovered_posts == 0);
    CHECK(found.flipped_triangles == 0);
    CHECK(found.worst_error <= 20.0);
    // Within a kilometre of the eye nothing has changed.
    double worst_near = 0.0;
    for (const auto& [a, b, c] : mesh.triangle) {
        const Eigen::Vector2d low = mesh.place[a].cwiseMin(mesh.place[b]).cwiseMin(mesh.place[c]);
        const Eigen::Vector2d high = mesh.place[a].cwiseMax(mesh.place[b]).cwiseMax(mesh.place[c]);
        for (int row = int(std::ceil(low.y())); row <= high.y(); ++row) {
            for (int column = int(std::ceil(low.x())); column <= high.x(); ++column) {
                if ((Eigen::Vector2d(column, row) - eye.place).norm() > 10.0) continue;
                Eigen::Matrix2d edges;
                edges << mesh.place[b] - mesh.place[a], mesh.place[c] - mesh.place[a];
                const Eigen::Vector2d w =
                    edges.inverse() * (Eigen::Vector2d(column, row) - mesh.place[a]);
                if (w.minCoeff() < -1e-9 || w.sum() > 1.0 + 1e-9) continue;
                const double height = mesh.height[a] + w.x() * (mesh.height[b] - mesh.height[a]) +
                                      w.y() * (mesh.height[c] - mesh.height[a]);
                worst_near = std::max(worst_near, std::abs(height - dem.at(row, column)));
            }
        }
    }
    CHECK(worst_near > 0.1);  // there were posts to look at
    CHECK(worst_near <= 1.0 + 1e-3);
}
