#include "terrain/relief/height_field.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "terrain/facets.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/read_dem.hpp"
#include "terrain/relief/horizon.hpp"
#include "terrain/relief/relief_sky.hpp"
#include "terrain/relief/relief_sun.hpp"
#include "terrain/relief/relief_sun_disc.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "tests/support/even_field.hpp"

// Closed forms as in view_factor_sampling_test.cpp: every part of a bowl sees the same share of
// sky, a V valley by its slope. Beside them robust rays, through the same triangles.

using namespace diurna;
using std::numbers::pi;

namespace {

HeightField field_of(int columns, int rows, double step,
                     const std::function<double(double, double)>& height) {
    std::vector<float> up;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            up.push_back(static_cast<float>(height(step * column, -step * row)));
        }
    }
    return even_field(columns, rows, up, step);
}

/// A spherical cap of diameter 2 and depth 2q below a plane, centre at (1.5, −1.5).
HeightField bowl(double q, int posts) {
    const double radius = (1.0 + 4.0 * q * q) / (4.0 * q);
    return field_of(posts, posts, 3.0 / (posts - 1), [=](double x, double y) {
        const double squared = (x - 1.5) * (x - 1.5) + (y + 1.5) * (y + 1.5);
        return squared >= 1.0 ? 0.0 : radius - 2.0 * q - std::sqrt(radius * radius - squared);
    });
}

/// The two triangles of each cell, cut as the field says.
FacetSet facets_of(const HeightField& field) {
    std::vector<Eigen::Vector3d> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;
    const auto at = [&](int row, int column) {
        return static_cast<std::uint32_t>(row * field.columns() + column);
    };
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            const Eigen::Vector2d p = field.place({column, row});
            vertex.emplace_back(p.x(), p.y(), field.up(row, column));
            if (row + 1 == field.rows() || column + 1 == field.columns()) continue;
            triangle.push_back({at(row, column), at(row + 1, column + 1), at(row, column + 1)});
            triangle.push_back({at(row, column), at(row + 1, column), at(row + 1, column + 1)});
        }
    }
    FacetSet facets;
    append_facets(facets, vertex, triangle, std::vector<MaterialId>(triangle.size()), ObjectId{0});
    return facets;
}

HeightField jacksboro() {
    const Dem dem = read_dem(DIURNA_SOURCE_DIR "/scenes/jacksboro/elevation.tif");
    const Geodetic centre = dem_centre(dem);
    return height_field(dem, {centre.latitude_deg, centre.longitude_deg, centre.height});
}

}  // namespace

TEST_CASE("posts of a bowl see the same share of sky",
          "[terrain][height_field][sky][by_comparison]") {
    struct Case {
        double q, sky_view;
    };
    const auto [q, expected] = GENERATE(values<Case>({{0.1, 0.961538462}, {0.2, 0.862068966}}));
    const HeightField field = bowl(q, 401);
    std::vector<float> seen(field.size());
    sky_view(field, 32, seen);
    double sum = 0.0, worst = 0.0;
    int count = 0;
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            if ((field.place({column, row}) - Eigen::Vector2d(1.5, -1.5)).norm() > 0.97) continue;
            const double error = seen[std::size_t(row) * field.columns() + column] - expected;
            sum += error;
            worst = std::max(worst, std::abs(error));
            ++count;
        }
    }
    CAPTURE(q, worst);
    CHECK(std::abs(sum / count) < 5e-4);
    CHECK(worst < 2e-3);
}

TEST_CASE("posts of a V valley see what its slope says, open at the border",
          "[terrain][height_field][sky][by_comparison]") {
    // A public tool never ends on this valley. Walls of slope b rise to the field's border, 1 from
    // the bottom along the slope; the valley is 20 times as long as wide, so its middle is nearly
    // infinite.
    const double b = 30.0 * pi / 180.0;
    const double step = std::cos(b) / 60.0;
    const HeightField field = field_of(
        121, 6001, step, [&](double x, double) { return std::abs(x - std::cos(b)) * std::tan(b); });
    std::vector<float> seen(field.size()), tangent(field.size());
    sky_view(field, 64, seen);
    for (const int column : {0, 15, 30, 45, 75, 105, 120}) {
        const double s = std::abs(column - 60) / 60.0, w = pi - 2.0 * b;
        const double exact =
            0.5 * (1.0 - (std::cos(w) - s) / std::sqrt(1.0 + s * s - 2.0 * s * std::cos(w)));
        // Above the horizontal alone: the crest's own plane ends where its outward horizon begins.
        CAPTURE(b, s);
        CHECK(seen[std::size_t(1200) * 121 + std::size_t(column)] == Approx(exact).margin(2e-3));
    }
    horizon(field, 90.0, tangent);  // east, from the last column outwards
    CHECK(tangent[std::size_t(1200) * 121 + 120] == 0.0f);
    CHECK(tangent[std::size_t(1200) * 121 + 60] == Approx(std::tan(b)).epsilon(1e-5));
    CHECK(tangent[std::size_t(1200) * 121] ==
          Approx(0.0).margin(1e-4));  // the other crest is as high
}

TEST_CASE("the shadow of a bowl on the grid covers the share that geometry says",
          "[terrain][height_field][sun][by_comparison]") {
    const double q = GENERATE(0.1, 0.2);
    const double elevation_deg = GENERATE(5.0, 10.0, 20.0, 30.0, 40.0);
    const double e = elevation_deg * pi / 180.0;
    const double k = (1.0 / (2.0 * q) - 2.0 * q) * std::tan(e) / 2.0;
    const double exact =
        k >= 1.0 ? 0.0
                 : 2.0 * std::cos(e) * std::cos(e) / pi * (std::acos(k) - k * std::sqrt(1 - k * k));
    const HeightField field = bowl(q, 1201);
    std::vector<float> fraction(field.size());
    sun_fraction(field, direction(70.0, elevation_deg), fraction);
    double shaded = 0.0, all = 0.0;
    for (int row = 0; row < field.rows(); ++row) {
        for (int column = 0; column < field.columns(); ++column) {
            if ((field.place({column, row}) - Eigen::Vector2d(1.5, -1.5)).norm() >= 1.0) continue;
            // The lit side of the bowl's wall turned away from the sun is in its own shadow.
            shaded += 1.0 - fraction[std::size_t(row) * field.columns() + column];
            all += 1.0;
        }
    }
    CAPTURE(q, elevation_deg);
    CHECK(shaded / all == Approx(exact).margin(2e-3));
}

TEST_CASE("horizons on real relief are those of robust rays", "[terrain][height_field][rays]") {
    // A tilted, uneven grid of latitudes and longitudes, bent a little by the Earth.
    const HeightField field = jacksboro();
    const RayScene rays(facets_of(field));
    std::vector<float> tangent(field.size());
    const double lift = 0.5;  // rays that start in the ground mean nothing
    double squares = 0.0;
    int count = 0;
    for (const double azimuth_deg : {0.0, 17.0, 45.0, 101.0, 135.0, 180.0, 236.0, 270.0, 299.0}) {
        horizon(field, azimuth_deg, tangent, lift);
        for (int k = 0; k < 100; ++k) {
            const int row = 2 + (k * 37) % (field.rows() - 4);
            const int column = 2 + (k * 89) % (field.columns() - 4);
            const Eigen::Vector2d p = field.place({column, row});
            const Eigen::Vector3f eye =
                Eigen::Vector3d(p.x(), p.y(), field.up(row, column) + lift).cast<float>();
            double low = 0.0, high = 80.0;
            for (int pass = 0; pass < 30; ++pass) {
                const double middle = 0.5 * (low + high);
                const Ray ray{.origin = eye,
                              .direction = direction(azimuth_deg, middle).cast<float>()};
                std::uint8_t blocked = 0;
                rays.occluded({&ray, 1}, {&blocked, 1});
                (blocked ? low : high) = middle;
            }
            const double seen =
                degrees(std::atan(double{tangent[std::size_t(row) * field.columns() + column]}));
            squares += (seen - low) * (seen - low);
            ++count;
        }
    }
    // 0.04° of azimuth at the far ends of 30 km changes some far horizons a little.
    CHECK(std::sqrt(squares / count) < 0.02);
}

TEST_CASE("on an even grid horizons are exact", "[terrain][height_field][rays][by_comparison]") {
    const auto hills = [](double x, double y) {
        return 120.0 * std::sin(x / 150.0) * std::cos(y / 230.0) +
               15.0 * std::sin(x / 23.0 + y / 31.0);
    };
    const HeightField field = field_of(200, 170, 10.0, hills);
    const RayScene rays(facets_of(field));
    std::vector<float> tangent(field.size());
    int wrong = 0;
    for (const double azimuth_deg : {3.0, 33.0, 88.0, 133.0, 211.0, 317.0, 348.0}) {
        horizon(field, azimuth_deg, tangent, 0.5);
        for (int k = 0; k < 200; ++k) {
            const int row = 1 + (k * 37) % 168, column = 1 + (k * 89) % 198;
            const double seen = tangent[std::size_t(row) * 200 + std::size_t(column)];
            for (const double beside : {-0.002, 0.002}) {  // blocked just below, free just above
                const double angle = degrees(std::atan(seen)) + beside;
                if (angle <= 0.0) continue;
                const Ray ray{.origin = Eigen::Vector3f(10.0f * column, -10.0f * row,
                                                        field.up(row, column) + 0.5f),
                              .direction = direction(azimuth_deg, angle).cast<float>()};
                std::uint8_t blocked = 0;
                rays.occluded({&ray, 1}, {&blocked, 1});
                wrong += (blocked != 0) != (beside < 0.0);
            }
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("the disc sinks behind a horizon over its width", "[terrain][height_field][sun]") {
    const double radius = sun_angular_radius;
    CHECK(disc_above(0.0f, 2.0 * radius) == 1.0f);
    CHECK(disc_above(0.0f, 0.0) == Approx(0.5));
    CHECK(disc_above(0.0f, -1.1 * radius) == 0.0f);
    const double h = 0.5;
    CHECK(disc_above(0.0f, h * radius) ==
          Approx(1.0 - (std::acos(h) - h * std::sqrt(1.0 - h * h)) / pi));
}

TEST_CASE("a field's plan answers both ways", "[terrain][height_field]") {
    const HeightField field = jacksboro();
    for (const Eigen::Vector2d& post : {Eigen::Vector2d(0, 0), {101.3, 222.7}, {343, 402}}) {
        CHECK((field.post(field.place(post)) - post).norm() < 1e-6);
    }
}

TEST_CASE("voids neither cast shadows nor lie in one", "[terrain][height_field][stress]") {
    const float hole = std::nanf("");
    const std::vector<float> up{0, hole, 5, 0, hole, 5, 0, hole, 5};
    const HeightField field = even_field(3, 3, up, 10.0);
    std::vector<float> fraction(9), seen(9);
    sun_fraction(field, direction(92.0, 10.0), fraction);
    CHECK(fraction[3] == 0.0f);  // the wall behind the hole stands there all the same
    CHECK(fraction[4] == 1.0f);
    CHECK(fraction[5] == 1.0f);
    sun_fraction(field, direction(92.0, 20.0), fraction);
    CHECK(fraction[3] == 1.0f);
    sky_view(field, 16, seen);
    CHECK(seen[4] == Approx(1.0));
    for (const float s : seen) CHECK((s > 0.5f && s <= 1.0f));
}

TEST_CASE("what is no surface is no height field", "[terrain][height_field][stress]") {
    const std::vector<float> up(9, 1.0f);
    CHECK_THROWS_AS(even_field(1, 9, up, 10.0), InputError);
    CHECK_THROWS_AS(even_field(3, 3, up, 0.0), InputError);
    CHECK_THROWS_AS(even_field(3, 3, up, std::nan("")), InputError);
}

TEST_CASE("any number of threads, the same horizons",
          "[terrain][height_field][invariance][by_replication]") {
    const HeightField field = jacksboro();
    std::vector<std::vector<float>> seen, lit;
    for (const int threads : {1, 3}) {
        set_thread_count(threads);
        seen.emplace_back(field.size());
        lit.emplace_back(field.size());
        sky_view(field, 8, seen.back());
        sun_fraction(field, direction(111.0, 9.0), lit.back());
    }
    set_thread_count(0);
    CHECK(seen[0] == seen[1]);
    CHECK(lit[0] == lit[1]);
}
