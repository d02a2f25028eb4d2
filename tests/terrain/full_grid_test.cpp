#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "terrain/ground/full_grid.hpp"
#include "terrain/ground/ground_mesh.hpp"
#include "terrain/ground/tin_check.hpp"

using namespace diurna;

namespace {

Dem bumps(int columns, int rows) {
    Dem dem;
    dem.source = "made";
    dem.columns = columns;
    dem.rows = rows;
    dem.transform = {420e3, 100.0, 0.0, 5100e3, 0.0, -100.0};
    dem.crs_wkt = "EPSG:32632";
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            dem.height.push_back(float(500 + 60 * std::sin(0.4 * c) * std::cos(0.3 * r)));
        }
    }
    return dem;
}

}  // namespace

TEST_CASE("the full grid has two triangles a cell along its diagonal", "[terrain][grid]") {
    const Dem dem = bumps(31, 22);
    const Tin tin = full_grid(dem);
    CHECK(tin.post.size() == 31 * 22);
    CHECK(tin.triangle.size() == 2 * 30 * 21);
    const TinCheck check = check_tin(dem, tin);
    CHECK(check.worst_error < 1e-9);
    CHECK(check.uncovered_posts == 0);
    CHECK(check.flipped_triangles == 0);
    for (const auto& [a, b, c] : tin.triangle) {
        const auto &p = tin.post[a], &q = tin.post[b], &r = tin.post[c];
        const int left = std::min({p[0], q[0], r[0]}), above = std::min({p[1], q[1], r[1]});
        const std::set<std::array<std::int32_t, 2>> corners{p, q, r};
        CHECK(corners.count({left, above}) == 1);
        CHECK(corners.count({left + 1, above + 1}) == 1);
    }
}

TEST_CASE("voids leave holes in the full grid and their rims are covered",
          "[terrain][grid][voids]") {
    Dem dem = bumps(20, 20);
    const float none = std::nanf("");
    for (int r = 5; r < 9; ++r) {
        for (int c = 3; c < 12; ++c) dem.height[std::size_t(r) * 20 + c] = none;
    }
    dem.height[0] = dem.height[19] = dem.height[15 * 20 + 15] = none;
    const Tin tin = full_grid(dem);
    const TinCheck check = check_tin(dem, tin);
    CHECK(check.worst_error < 1e-9);
    CHECK(check.uncovered_posts == 0);
    CHECK(check.flipped_triangles == 0);
    // Cells: 19 × 19. The block touches 5 × 10 of them, all but its four corners' without any
    // triangle; each void alone leaves its cells one triangle, those at the raster's corner too.
    CHECK(tin.triangle.size() == 2 * (361 - 50 - 1 - 1 - 4) + 4 + 1 + 1 + 4);
}

TEST_CASE("footprints cut the full grid and it keeps every post", "[terrain][grid][ground]") {
    const Dem dem = bumps(31, 22);
    const std::vector<Footprint> footprints{{{{5.3, 4.2}, {12.9, 6.1}, {9.4, 15.7}}, 150.0}};
    const GroundMesh mesh = ground_mesh(dem, full_grid(dem), 0.0, footprints);
    const TinCheck check = check_ground_mesh(dem, mesh);
    CHECK(check.worst_error < 1e-6);
    CHECK(check.uncovered_posts == 0);
    CHECK(check.flipped_triangles == 0);
    double inside = 0.0;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        if (mesh.footprint[t] != 0) continue;
        const auto& [a, b, c] = mesh.triangle[t];
        const Eigen::Vector2d u = mesh.place[b] - mesh.place[a], v = mesh.place[c] - mesh.place[a];
        inside += 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
    }
    // Shoelace over the three corners.
    const double exact = 0.5 * std::abs((12.9 - 5.3) * (15.7 - 4.2) - (9.4 - 5.3) * (6.1 - 4.2));
    CHECK(inside == Approx(exact).epsilon(1e-9));
}

TEST_CASE("a small footprint on a coarse raster is cut as fine as it requests",
          "[terrain][grid][ground]") {
    Dem dem = bumps(5, 5);
    dem.transform = {420e3, 550.0, 0.0, 5100e3, 0.0, -550.0};
    // Squares of 0.6 m with edges of 0.08 m, and one of 2 m that asks for none.
    const auto square = [](double column, double row, double side) {
        const double half = 0.5 * side / 550.0;
        return std::vector<Eigen::Vector2d>{{column - half, row - half},
                                            {column + half, row - half},
                                            {column + half, row + half},
                                            {column - half, row + half}};
    };
    const std::vector<Footprint> footprints{{square(1.3, 2.4, 0.6), 0.08}, {square(2.6, 1.7, 2.0)}};
    const GroundMesh mesh = ground_mesh(dem, full_grid(dem), 0.0, footprints);
    double area[2] = {0.0, 0.0}, longest = 0.0;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        if (mesh.footprint[t] < 0) continue;
        const auto& [a, b, c] = mesh.triangle[t];
        const Eigen::Vector2d u = 550.0 * (mesh.place[b] - mesh.place[a]),
                              v = 550.0 * (mesh.place[c] - mesh.place[a]);
        area[mesh.footprint[t]] += 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
        if (mesh.footprint[t] == 0) longest = std::max({longest, u.norm(), v.norm()});
    }
    CHECK(area[0] == Approx(0.36).epsilon(1e-6));
    CHECK(area[1] == Approx(4.0).epsilon(1e-6));
    CHECK(longest < 1.5 * 0.08);
}
