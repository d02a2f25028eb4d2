#include "terrain/ground/dem_detail.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "materials/base/error.hpp"
#include "terrain/ground/full_grid.hpp"
#include "terrain/ground/ground_mesh.hpp"
#include "terrain/ground/rings.hpp"
#include "terrain/ground/tin_check.hpp"
#include "terrain/place/site.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/dem_window.hpp"
#include "terrain/raster/read_dem.hpp"
#include "tests/support/detailed_relief.hpp"
#include "tests/support/shared_data.hpp"

// Finer rasters on a coarse one, of other lattices and maps, against the surface all are sampled
// from.

using namespace diurna;
using namespace detailed_relief;

namespace {

const Eigen::Vector2d peak(677100.0, 6398250.0);  // on the map of UTM zone 32

double gauss(const Eigen::Vector2d& from, double width) {
    return std::exp(-0.5 * from.squaredNorm() / (width * width));
}

/// Hills of 250 m width, and one of 25 m that posts 30 m apart do not show.
double surface(const Eigen::Vector2d& at) {
    return 120.0 + 80.0 * gauss(at - Eigen::Vector2d(676600.0, 6397600.0), 400.0) +
           50.0 * gauss(at - Eigen::Vector2d(677300.0, 6398500.0), 250.0) +
           30.0 * gauss(at - peak, 25.0);
}

Dem fine_raster(double east = 676800.0, double north = 6398550.0, int posts = 301,
                double spacing = 2.0) {
    return lattice("fine.tif", utm_32, posts, posts, east, north, spacing);
}

Dem with_detail(double tolerance = 0.05) {
    Dem dem = sampled(seconds_lattice(), surface);
    lay_detail(dem, sampled(fine_raster(), surface), {.tolerance = tolerance, .blend = 30.0});
    return dem;
}

double height_on(const GroundMesh& mesh, std::size_t t, const Eigen::Vector2d& p) {
    const auto& [i, j, k] = mesh.triangle[t];
    const Eigen::Vector2d &a = mesh.place[i], &b = mesh.place[j], &c = mesh.place[k];
    const double wa = turn(p, b, c), wb = turn(a, p, c), wc = turn(a, b, p);
    return (wa * mesh.height[i] + wb * mesh.height[j] + wc * mesh.height[k]) / (wa + wb + wc);
}

/// Twice the area of all triangles over that of the raster, in posts².
double share_covered(const Dem& dem, const GroundMesh& mesh) {
    double sum = 0.0;
    for (const auto& [a, b, c] : mesh.triangle) {
        sum += turn(mesh.place[a], mesh.place[c], mesh.place[b]);
    }
    return sum / (2.0 * (dem.columns - 1.0) * (dem.rows - 1.0));
}

using Edges = std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>>;

/// Edges with the triangles at them.
Edges edges_of(const GroundMesh& mesh) {
    Edges edges;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = mesh.triangle[t][k], b = mesh.triangle[t][(k + 1) % 3];
            edges[std::minmax(a, b)].push_back(t);
        }
    }
    return edges;
}

/// No triangle over another, no hole, no crack: the areas add up, and every edge has two triangles
/// or lies on the raster's edge.
void check_whole(const Dem& dem, const GroundMesh& mesh) {
    CHECK(share_covered(dem, mesh) == Approx(1.0).epsilon(1e-9));
    std::size_t open = 0;
    for (const auto& [edge, triangles] : edges_of(mesh)) {
        const Eigen::Vector2d a = mesh.place[edge.first], b = mesh.place[edge.second];
        const Eigen::Vector2d last(dem.columns - 1.0, dem.rows - 1.0);
        bool at_edge = false;
        for (int axis = 0; axis < 2; ++axis) {
            for (const double side : {0.0, last[axis]}) {
                at_edge = at_edge || (a[axis] == side && b[axis] == side);
            }
        }
        if (triangles.size() != (at_edge ? 1 : 2)) ++open;
    }
    CHECK(open == 0);
    const TinCheck check = check_ground_mesh(dem, mesh);
    CHECK(check.uncovered_posts == 0);
    CHECK(check.flipped_triangles == 0);
}

std::string refusal(Dem fine, const DetailOptions& options = {}) {
    Dem dem = sampled(seconds_lattice(), surface);
    try {
        lay_detail(dem, std::move(fine), options);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

// Krüger's series to the sixth order (Karney 2011, J. Geod. 85, eq. 35 and 36), worked out apart
// from this program: 57.691525390 N, 11.971216543 E.
TEST_CASE("a place of a detail is where its map has it", "[terrain][detail]") {
    const auto alone = [](const Eigen::Vector2d& at) { return 30.0 * gauss(at - peak, 25.0); };
    Dem dem = sampled(seconds_lattice(), alone);
    lay_detail(dem, sampled(fine_raster(), alone), {.tolerance = 1e-3, .blend = 30.0});
    const DemDetail& detail = dem.detail.front();
    const Geodetic expected{57.691525390, 11.971216543, 0.0};
    const Site there{expected.latitude_deg, expected.longitude_deg, 0.0};
    const auto metres_off = [&](const Eigen::Vector2d& coarse) {
        const float level = 0.0f;
        return to_local(there, geodetic_places(dem, {&coarse, 1}, {&level, 1}).front())
            .head<2>()
            .norm();
    };
    CHECK(metres_off(detail.to_coarse({150.0, 150.0})) < 1e-3);
    // Both ways, everywhere on it.
    for (const double x : {0.0, 33.3, 300.0}) {
        for (const double y : {0.0, 151.7, 300.0}) {
            const Eigen::Vector2d own(x, y);
            CHECK((detail.to_own(detail.to_coarse(own)) - own).norm() < 1e-6);
        }
    }
    // The mesh has its summit there.
    const GroundMesh mesh = ground_mesh(dem, 1.0);
    std::size_t highest = 0;
    for (std::size_t v = 0; v < mesh.place.size(); ++v) {
        const bool near = metres_off(mesh.place[v]) < 60.0;
        if (near && mesh.height[v] > mesh.height[highest]) highest = v;
    }
    CHECK(metres_off(mesh.place[highest]) < 0.1);
    CHECK(mesh.height[highest] == Approx(30.0).margin(1e-3));
}

TEST_CASE("a mesh over a detail is the surface both are sampled from", "[terrain][detail]") {
    const double tolerance = GENERATE(0.05, 0.5);
    CAPTURE(tolerance);
    const Dem dem = with_detail(tolerance);
    const GroundMesh mesh = ground_mesh(dem, 1.0);
    check_whole(dem, mesh);
    const TinCheck check = check_ground_mesh(dem, mesh);
    CHECK(check.worst_on_detail <= tolerance + 1e-3);
    CHECK(check.worst_error <= 1.0 + 1e-3);

    // In the middle of each triangle and near its corners, 30 m and more from the border: within
    // the tolerance and what lies between posts 2 m apart, 1/8 f'' h², 0.024 m on the narrow hill,
    // twice that along diagonals.
    std::size_t inside = 0;
    double worst = 0.0;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        if (mesh.detail[t] < 0) continue;
        const auto& [i, j, k] = mesh.triangle[t];
        const Eigen::Vector2d &a = mesh.place[i], &b = mesh.place[j], &c = mesh.place[k];
        const std::vector<Eigen::Vector2d> places{(a + b + c) / 3.0, 0.8 * a + 0.1 * (b + c),
                                                  0.8 * b + 0.1 * (a + c)};
        const auto at = on_map(dem, places);
        for (std::size_t n = 0; n < places.size(); ++n) {
            const Eigen::Vector2d own = dem.detail.front().to_own(places[n]);
            if (own.minCoeff() < 15.0 || own.maxCoeff() > 285.0) continue;
            ++inside;
            worst = std::max(worst, std::abs(height_on(mesh, t, places[n]) - surface(at[n])));
        }
    }
    CAPTURE(worst, inside, mesh.triangle.size());
    CHECK(inside > 500);
    CHECK(worst <= tolerance + 0.05);
}

TEST_CASE("at its border a detail has the coarse raster's heights", "[terrain][detail]") {
    // 25 m higher, as where one counts from the ellipsoid.
    const Dem coarse = sampled(seconds_lattice(), surface);
    Dem fine = sampled(fine_raster(), surface);
    for (float& height : fine.height) height += 25.0f;
    Dem dem = coarse;
    lay_detail(dem, fine, {.tolerance = 0.05, .blend = 30.0});
    REQUIRE(dem.notes.size() == 1);
    CHECK(dem.notes.front() ==
          "fine.tif: is 25.0 m above coarse.tif in the blending strip (median): check "
          "vertical_datum and height_unit of both");

    const GroundMesh mesh = ground_mesh(dem, 1.0);
    check_whole(dem, mesh);
    double worst = 0.0;
    std::size_t border = 0;
    for (const auto& [edge, triangles] : edges_of(mesh)) {
        if (triangles.size() != 2) continue;
        if (mesh.detail[triangles[0]] == mesh.detail[triangles[1]]) continue;
        ++border;
        for (const std::uint32_t v : {edge.first, edge.second}) {
            worst = std::max(worst, std::abs(mesh.height[v] - height_at(coarse, mesh.place[v])));
        }
    }
    CAPTURE(worst);
    CHECK(border > 40);
    CHECK(worst < 1e-3);

    // w fine + (1 − w) coarse, w = 3 t² − 2 t³: half way 12.5 m up, 15.625 % of it after a quarter.
    const auto lifted = [&](double column) {
        const Eigen::Vector2d at = dem.detail.front().to_coarse({column, 150.0});
        return height_at(dem, at) - surface(on_map(dem, {at}).front());
    };
    CHECK(lifted(15.0) == Approx(25.0).margin(0.01));
    CHECK(lifted(7.5) == Approx(12.5).margin(0.3));  // the coarse raster's own error counts
    CHECK(lifted(3.75) == Approx(25.0 * 0.15625).margin(0.3));
    CHECK(lifted(0.0) == Approx(0.0).margin(0.3));
    // The coarse posts show the same surface.
    const Eigen::Vector2d middle = dem.detail.front().to_coarse({200.0, 100.0});
    const Eigen::Vector2d post(std::round(middle.x()), std::round(middle.y()));
    CHECK(dem.at(int(post.y()), int(post.x())) ==
          Approx(25.0 + surface(on_map(dem, {post}).front())).margin(0.01));
}

TEST_CASE("details hang over the edge, overlap and share a border without hole or fold",
          "[terrain][detail]") {
    Dem dem = sampled(seconds_lattice(), surface);
    const DetailOptions options{.tolerance = 0.1, .blend = 20.0};
    SECTION("over the north edge") {
        lay_detail(dem, sampled(fine_raster(676400.0, 6399500.0), surface), options);
    }
    SECTION("over a corner") {
        lay_detail(dem, sampled(fine_raster(675600.0, 6399400.0), surface), options);
    }
    SECTION("wider than the coarse one") {
        lay_detail(dem, sampled(fine_raster(675000.0, 6400200.0, 501, 10.0), surface), options);
        CHECK(detail_at(dem, {70.0, 50.0}) == 0);
    }
    SECTION("one partly on another") {
        lay_detail(dem, sampled(fine_raster(676600.0, 6398700.0), surface), options);
        lay_detail(dem, sampled(fine_raster(677003.3, 6398351.7, 401, 1.0), surface), options);
        CHECK(detail_at(dem, dem.detail[1].to_coarse({50.0, 50.0})) == 1);
    }
    SECTION("one wholly on another") {
        lay_detail(dem, sampled(fine_raster(676600.0, 6398700.0), surface), options);
        lay_detail(dem, sampled(fine_raster(676903.3, 6398551.7, 201, 1.0), surface), options);
    }
    SECTION("side by side") {
        lay_detail(dem, sampled(fine_raster(676500.0, 6398500.0, 201), surface), options);
        lay_detail(dem, sampled(fine_raster(676900.0, 6398500.0, 201), surface), options);
    }
    const GroundMesh mesh = ground_mesh(dem, 1.0);
    check_whole(dem, mesh);
    const TinCheck check = check_ground_mesh(dem, mesh);
    CAPTURE(mesh.triangle.size());
    CHECK(check.worst_on_detail <= 0.1 + 0.02);  // posts beside an edge are skipped
    CHECK(check.worst_error <= 1.0 + 1e-3);
}

TEST_CASE("rings are cut into a detail as into any ground", "[terrain][detail][footprint]") {
    const Dem dem = with_detail();
    const DemDetail& detail = dem.detail.front();
    std::vector<Footprint> prints;
    Ring within, across;
    for (const auto& [x, y] : {std::pair{120.3, 90.2}, {160.9, 95.4}, {150.1, 140.8}}) {
        within.push_back(detail.to_coarse({x, y}));
    }
    for (const auto& [x, y] :
         {std::pair{-40.0, 210.0}, {60.0, 210.0}, {60.0, 260.0}, {-40.0, 260.0}}) {
        across.push_back(detail.to_coarse({x, y}));
    }
    prints.push_back({.ring = within, .largest_edge = 3.0});
    prints.push_back({.ring = across, .largest_edge = 20.0});
    const GroundMesh mesh = ground_mesh(dem, 1.0, prints);
    check_whole(dem, mesh);
    CHECK(check_ground_mesh(dem, mesh).worst_on_detail <= 0.05 + 1e-3);
    const auto area = [](const Ring& ring) {
        double sum = 0.0;
        for (std::size_t i = 2; i < ring.size(); ++i) sum += turn(ring[0], ring[i - 1], ring[i]);
        return std::abs(sum);
    };
    double owned[2] = {0.0, 0.0};
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        if (mesh.footprint[t] < 0) continue;
        const auto& [a, b, c] = mesh.triangle[t];
        owned[mesh.footprint[t]] += turn(mesh.place[a], mesh.place[c], mesh.place[b]);
    }
    CHECK(owned[0] == Approx(area(within)).epsilon(2e-3));
    CHECK(owned[1] == Approx(area(across)).epsilon(2e-3));
}

TEST_CASE("the full grid has every post of a detail", "[terrain][detail][grid]") {
    Dem dem = sampled(seconds_lattice(), surface);
    lay_detail(dem, sampled(fine_raster(676800.0, 6398550.0, 81), surface),
               {.tolerance = 1.0, .blend = 20.0});
    const Tin fine = full_grid(dem.detail.front().raster);
    const GroundMesh mesh = ground_mesh(dem, full_grid(dem), 1.0, {}, {}, {&fine, 1});
    check_whole(dem, mesh);
    std::size_t on_detail = 0;
    for (const std::int32_t k : mesh.detail) on_detail += k >= 0;
    CHECK(on_detail > 2 * 79 * 79);
    CHECK(check_ground_mesh(dem, mesh).worst_on_detail < 1.0);
}

// A city and its hill in 2.5 m (terrain models of Scotland, phase 5) in means over 30 m of them.
TEST_CASE("a measured model lies in a coarse one", "[terrain][detail][samples]") {
    const auto file = shared_data("data/dem/holyrood_dsm_2p5m_osgb.tif");
    if (!file) return;
    const Dem whole = read_dem(*file, {.voids = VoidPolicy::fill});
    constexpr int side = 12;
    Dem coarse;
    coarse.source = "means.tif";
    coarse.columns = whole.columns / side;
    coarse.rows = whole.rows / side;
    coarse.crs_wkt = whole.crs_wkt;
    coarse.transform = whole.transform;
    for (const std::size_t k : {1u, 2u, 4u, 5u}) coarse.transform[k] *= side;
    for (int row = 0; row < coarse.rows; ++row) {
        for (int column = 0; column < coarse.columns; ++column) {
            double sum = 0.0;
            for (int k = 0; k < side * side; ++k) {
                sum += whole.at(side * row + k / side, side * column + k % side);
            }
            coarse.height.push_back(static_cast<float>(sum / (side * side)));
        }
    }
    Dem fine = whole;
    crop(fine, {200, 150, 320, 240});
    fine.is_void.clear();
    Dem dem = coarse;
    lay_detail(dem, fine, {.tolerance = 0.5, .blend = 60.0});
    CHECK(dem.notes.size() == fine.notes.size());  // no step between the two

    const GroundMesh mesh = ground_mesh(dem, 3.0);
    check_whole(dem, mesh);
    const TinCheck check = check_ground_mesh(dem, mesh);
    CHECK(check.worst_on_detail <= 0.5 + 1e-3);
    CHECK(check.worst_error <= 3.0 + 1e-3);
    // Inside the strip the raster's own posts stand.
    const DemDetail& detail = dem.detail.front();
    for (const auto& [column, row] : {std::pair{60, 60}, {160, 100}, {290, 200}}) {
        CHECK(height_at(dem, detail.to_coarse({double(column), double(row)})) ==
              Approx(fine.at(row, column)).margin(0.01));
    }
}

TEST_CASE("what cannot be a detail is refused in one line", "[terrain][detail][stress]") {
    Dem holed = sampled(fine_raster(), surface);
    holed.height[5000] = std::nanf("");
    CHECK(
        refusal(holed) ==
        "fine.tif: has posts without elevation, which a detail cannot have (set voids = \"fill\")");
    CHECK(refusal(sampled(fine_raster(500000.0, 6398550.0), surface)) ==
          "fine.tif: is entirely outside coarse.tif");
    CHECK(refusal(sampled(fine_raster(676000.0, 6399000.0, 21, 90.0), surface))
              .find("fine.tif: has posts 90 m apart, coarse.tif 30.9 m; a detail must be finer") ==
          0);
    CHECK(refusal(sampled(fine_raster(), surface), {.blend = 400.0})
              .find("fine.tif: is 600 m wide, less than the two blending strips of 400 m") == 0);
}
