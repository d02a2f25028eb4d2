#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <vector>

#include "terrain/ground/full_grid.hpp"
#include "terrain/ground/ground_mesh.hpp"
#include "terrain/ground/tin_check.hpp"
#include "terrain/raster/dem_places.hpp"

using namespace diurna;

namespace {

Dem made_dem(int posts, double spacing, double relief) {
    Dem dem;
    dem.columns = dem.rows = posts;
    dem.transform = {420e3, spacing, 0.0, 5100e3, 0.0, -spacing};
    dem.crs_wkt = "EPSG:32631";
    for (int r = 0; r < posts; ++r) {
        for (int c = 0; c < posts; ++c) {
            const double x = c * spacing, y = r * spacing;
            dem.height.push_back(float(100.0 + relief * std::sin(x / 60.0) * std::cos(y / 75.0)));
        }
    }
    return dem;
}

/// A square about (column, row), turned.
std::vector<Eigen::Vector2d> square(double column, double row, double half, double turned = 0.0) {
    std::vector<Eigen::Vector2d> ring;
    for (int k = 0; k < 4; ++k) {
        const double a = turned + 0.7853981634 + 1.5707963268 * k;
        ring.emplace_back(column + 1.41421356 * half * std::cos(a),
                          row + 1.41421356 * half * std::sin(a));
    }
    return ring;
}

/// As a scene refines ground around an object.
Footprint refined(std::vector<Eigen::Vector2d> ring, double edge) {
    return {.ring = std::move(ring),
            .largest_edge = edge,
            .owner = false,
            .border = false,
            .growth = 0.5};
}

struct Triangle {
    Eigen::Vector2d middle;  // [m]
    double shortest = 1e300, longest = 0.0, least_angle_deg = 180.0, area = 0.0;
};
Triangle triangle_of(const GroundMesh& mesh, std::size_t t, const Eigen::Vector2d& spacing) {
    std::array<Eigen::Vector2d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
        p[k] = mesh.place[mesh.triangle[t][k]].cwiseProduct(spacing);
    }
    Triangle of;
    of.middle = (p[0] + p[1] + p[2]) / 3.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Eigen::Vector2d u = p[(k + 1) % 3] - p[k], v = p[(k + 2) % 3] - p[k];
        of.shortest = std::min(of.shortest, u.norm());
        of.longest = std::max(of.longest, u.norm());
        const double angle = std::acos(u.dot(v) / (u.norm() * v.norm())) * 57.29577951;
        of.least_angle_deg = std::min(of.least_angle_deg, angle);
        of.area = 0.5 * std::abs(u.x() * v.y() - u.y() * v.x());
    }
    return of;
}

/// [m] from a square's border, 0 inside.
double outside(const Eigen::Vector2d& p, const Eigen::Vector2d& middle, double half) {
    const Eigen::Vector2d off = ((p - middle).cwiseAbs().array() - half).max(0.0);
    return off.norm();
}

}  // namespace

// Ground of 10 m to 400 m around a square of 20 m with edges of 0.8 m, wherever its posts are.
TEST_CASE("triangles grow gradually from fine ground to coarse, without slivers",
          "[terrain][ground][graded]") {
    const double spacing = GENERATE(10.0, 30.0, 200.0);
    const double relief = GENERATE(0.0, 6.0);
    const double shift = GENERATE(0.0, 0.13, 0.48);
    const Dem dem = made_dem(21, spacing, relief);
    const Eigen::Vector2d metres = post_spacing(dem);
    const double half = 10.0, edge = 0.8;
    const Eigen::Vector2d place(10.0 + shift, 10.0 + 0.7 * shift);
    const std::vector<Footprint> patch{
        refined(square(place.x(), place.y(), half / metres.x()), edge)};
    const bool grid = GENERATE(true, false);
    const double tolerance = 1.0;
    const GroundMesh mesh = grid ? ground_mesh(dem, full_grid(dem), tolerance, patch)
                                 : ground_mesh(dem, tolerance, patch);
    const TinCheck check = check_ground_mesh(dem, mesh);
    CHECK(check.worst_error <= tolerance + 1e-9);
    CHECK(check.flipped_triangles == 0);
    CHECK(check.uncovered_posts == 0);

    const Eigen::Vector2d middle = place.cwiseProduct(metres);
    std::size_t zone = 0, inside = 0, thin = 0;
    double least_angle = 180.0, most_over = 0.0, covered = 0.0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> sides;
    std::vector<Triangle> all;
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        all.push_back(triangle_of(mesh, t, metres));
        const Triangle& of = all.back();
        covered += of.area;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto a = mesh.triangle[t][k], b = mesh.triangle[t][(k + 1) % 3];
            sides[std::minmax(a, b)].push_back(t);
        }
        const double off = outside(of.middle, middle, half), wanted = edge + 0.5 * off;
        if (off == 0.0) ++inside;
        if (off > 0.0 && wanted < 0.5 * spacing) {
            ++zone;
            least_angle = std::min(least_angle, of.least_angle_deg);
            thin += of.least_angle_deg < 25.0;
            most_over = std::max(most_over, of.longest / wanted);
        }
    }
    std::vector<double> ratios;
    for (const auto& [side, two] : sides) {
        if (two.size() < 2) continue;
        const Triangle &a = all[two[0]], &b = all[two[1]];
        const double off = outside(a.middle, middle, half);
        if (off == 0.0 || edge + 0.5 * off > 0.5 * spacing) continue;
        const double ratio = std::sqrt(a.area / b.area);
        ratios.push_back(std::max(ratio, 1.0 / ratio));
    }
    std::sort(ratios.begin(), ratios.end());
    CAPTURE(spacing, relief, shift, grid, inside, zone, thin, least_angle, most_over);
    CAPTURE(ratios[ratios.size() / 2], ratios[ratios.size() * 9 / 10], ratios.back());
    CHECK(covered == Approx(20.0 * 20.0 * metres.x() * metres.y()).epsilon(1e-9));
    CHECK(least_angle > 20.0);
    CHECK(most_over < 1.5);
    CHECK(zone < (spacing > 100.0 ? 1400 : 950));
    CHECK(inside < 3200);
    CHECK(ratios[ratios.size() / 2] < 1.2);
    CHECK(ratios[ratios.size() * 9 / 10] < 1.5);
    CHECK(ratios.back() < 3.0);
}
