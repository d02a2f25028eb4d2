#include "terrain/visibility/relief_visibility.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "terrain/ground/ground_mesh.hpp"
#include "terrain/objects/box.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/read_dem.hpp"
#include "terrain/relief/relief_sun.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"

// The march over the grid against rays through the mesh, on the sample scene's relief.

using namespace diurna;

namespace {

struct Ground {
    Dem dem;
    Site site;
    HeightField relief;
    FacetSet facets;
    std::size_t ground_facets;
    RayScene rays;

    ReliefVisibility light() const { return {facets, rays, relief, ground_facets}; }
};

Ground jacksboro(double tolerance, bool with_box) {
    Dem dem = read_dem(DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif");
    const Geodetic centre = dem_centre(dem);
    const Site site{centre.latitude_deg, centre.longitude_deg, centre.height};
    HeightField relief = height_field(dem, site);
    const GroundMesh mesh = ground_mesh(dem, tolerance);
    FacetSet facets;
    append_facets(facets, local_vertices(dem, site, mesh.place, mesh.height), mesh.triangle,
                  std::vector<MaterialId>(mesh.triangle.size()), ObjectId{0});
    const std::size_t ground = facets.size();
    if (with_box) {
        append_facets(facets,
                      box({.base = Eigen::Vector3d(300.0, -200.0, 20.0),
                           .width = 400.0,
                           .depth = 60.0,
                           .height = 250.0,
                           .sunk = 100.0,
                           .largest_edge = 60.0}),
                      ObjectId{1});
    }
    RayScene rays(facets);
    return {std::move(dem), site, std::move(relief), std::move(facets), ground, std::move(rays)};
}

/// Mean and rms over the ground, by area, of a difference.
struct Difference {
    double mean = 0.0, rms = 0.0;
};
Difference difference(const Ground& ground, const std::function<double(std::size_t)>& of) {
    double sum = 0.0, squares = 0.0, area = 0.0;
    for (std::size_t f = 0; f < ground.ground_facets; ++f) {
        const double d = of(f), a = ground.facets.area[f];
        sum += a * d;
        squares += a * d * d;
        area += a;
    }
    return {sum / area, std::sqrt(squares / area)};
}

}  // namespace

TEST_CASE("march and rays light the ground alike, beside a tall building too",
          "[terrain][relief_light][sun]") {
    const Ground ground = jacksboro(2.0, true);
    const ReliefVisibility light = ground.light();
    const std::size_t n = ground.facets.size();
    std::vector<float> marched(n), cast(n), fine(n);
    for (const double elevation_deg : {6.0, 35.0}) {
        const Eigen::Vector3d sun = direction(100.0 + elevation_deg, elevation_deg);
        const std::size_t by_rays = light.sun_fraction(sun, marched);
        sun_fraction(ground.facets, ground.rays, sun, cast);
        sun_fraction(ground.facets, ground.rays, sun, fine, {.samples = 25, .seed = 7});
        const auto beam = [&](std::size_t f) {
            return std::max(0.0f, ground.facets.normal[f].dot(sun.cast<float>()));
        };
        const Difference by_march =
            difference(ground, [&](std::size_t f) { return beam(f) * (marched[f] - fine[f]); });
        const Difference four_rays =
            difference(ground, [&](std::size_t f) { return beam(f) * (cast[f] - fine[f]); });
        CAPTURE(elevation_deg, by_march.mean, by_march.rms, four_rays.rms, by_rays);
        CHECK(std::abs(by_march.mean) < 5e-4);
        CHECK(by_march.rms < 1.1 * four_rays.rms + 2e-3);
        CHECK(by_rays < 0.35 * double(n));
        for (std::size_t f = ground.ground_facets; f < n; ++f) REQUIRE(marched[f] == cast[f]);
    }
}

TEST_CASE("the march sees the same sky as many rays, with less noise",
          "[terrain][relief_light][sky][by_replication]") {
    const Ground ground = jacksboro(12.0, true);
    const FacetViews marched = ground.light().facet_views({.rays = 16});
    const FacetViews cast = facet_views(ground.facets, ground.rays, {.rays = 64});
    const FacetViews fine = facet_views(ground.facets, ground.rays, {.rays = 256, .seed = 5});
    const Difference by_march =
        difference(ground, [&](std::size_t f) { return double{marched.sky[f]} - fine.sky[f]; });
    const Difference by_rays =
        difference(ground, [&](std::size_t f) { return double{cast.sky[f]} - fine.sky[f]; });
    CAPTURE(by_march.mean, by_march.rms, by_rays.rms);
    CHECK(std::abs(by_march.mean) < 2e-3);
    CHECK(by_march.rms < 0.8 * by_rays.rms);
    for (std::size_t f = 0; f < ground.facets.size(); ++f) {
        double whole = double{marched.sky[f]} + marched.below[f];
        for (auto k = marched.others.row[f]; k < marched.others.row[f + 1]; ++k) {
            whole += marched.others.factor[k];
        }
        REQUIRE(whole == Approx(1.0).epsilon(2e-6));
    }
}

TEST_CASE("a coarse mesh carries the light of the fine relief",
          "[terrain][relief_light][sun][by_variation]") {
    // Mean beam over all ground, per plan area, from posts alone.
    const Ground ground = jacksboro(40.0, false);
    const double elevation_deg = GENERATE(10.0, 25.0, 50.0);
    const Eigen::Vector3d sun = direction(120.0, elevation_deg);
    std::vector<float> fraction(ground.facets.size()), posts(ground.relief.size());
    ground.light().sun_fraction(sun, fraction);
    sun_fraction(ground.relief, sun, posts);
    double fine = 0.0, coarse = 0.0, plan = 0.0;
    std::size_t count = 0;
    for (int row = 0; row < ground.relief.rows(); ++row) {
        for (int column = 0; column < ground.relief.columns(); ++column, ++count) {
            const double lit = posts[count];
            const Eigen::Vector3f normal = ground.relief.normal(row, column);
            fine += lit * std::max(0.0f, normal.dot(sun.cast<float>())) / normal.z();
        }
    }
    for (std::size_t f = 0; f < ground.facets.size(); ++f) {
        const Eigen::Vector3f& normal = ground.facets.normal[f];
        const double area = ground.facets.area[f];
        coarse += area * fraction[f] * std::max(0.0f, normal.dot(sun.cast<float>()));
        plan += area * normal.z();
    }
    CAPTURE(elevation_deg, ground.facets.size());
    CHECK(coarse / plan == Approx(fine / double(count)).epsilon(0.02));
}

TEST_CASE("any number of threads, the same light",
          "[terrain][relief_light][invariance][by_replication]") {
    const Ground ground = jacksboro(20.0, true);
    std::vector<std::vector<float>> lit, seen;
    for (const int threads : {1, 3}) {
        set_thread_count(threads);
        const ReliefVisibility light = ground.light();
        lit.emplace_back(ground.facets.size());
        light.sun_fraction(direction(111.0, 9.0), lit.back());
        seen.push_back(light.facet_views({.rays = 16}).sky);
    }
    set_thread_count(0);
    CHECK(lit[0] == lit[1]);
    CHECK(seen[0] == seen[1]);
}
