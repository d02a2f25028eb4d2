#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <numbers>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "render/view/cast_view.hpp"
#include "render/view/observer.hpp"
#include "render/view/pixel_rays.hpp"
#include "render/view/view.hpp"
#include "terrain/place/site.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"

using namespace diurna;

namespace {

Observer upward(Projection projection, int size) {
    Observer observer;
    observer.elevation_deg = 90.0;
    observer.horizontal_fov_deg = 180.0;
    observer.width = observer.height = size;
    observer.projection = projection;
    return observer;
}

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return degrees(std::atan2(a.cross(b).norm(), a.dot(b)));
}

/// Solid angle of a pixel: that of the two triangles of its corners (Van Oosterom & Strackee 1983).
double solid_angle(const PixelRays& rays, double column, double row) {
    const auto triangle = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& c) {
        return 2.0 * std::atan2(std::abs(a.dot(b.cross(c))), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
    };
    const Eigen::Vector3d a = rays.towards(column, row), b = rays.towards(column + 1, row),
                          c = rays.towards(column + 1, row + 1), d = rays.towards(column, row + 1);
    return triangle(a, b, c) + triangle(a, c, d);
}

}  // namespace

TEST_CASE("a focal plane's field of view follows from pitch and focal length",
          "[render][projection]") {
    // 640 pixels of 15 µm are 9.6 mm; behind 50 mm: 2 atan(4.8 / 50) = 10.967°.
    CHECK(field_of_view_deg(640, 15.0, 50.0) == Approx(10.96718).epsilon(1e-5));
}

TEST_CASE("fisheyes put directions where their laws say", "[render][projection]") {
    const PixelRays equidistant = pixel_rays(upward(Projection::equidistant, 400));
    const PixelRays equisolid = pixel_rays(upward(Projection::equisolid, 400));
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    for (const double part : {0.1, 0.5, 0.8, 1.0}) {
        CAPTURE(part);
        CHECK(angle_deg(equidistant.towards(200.0 + 200.0 * part, 200.0), up) ==
              Approx(90.0 * part).epsilon(1e-9));
        // r/R = sin(θ/2) / sin 45°
        CHECK(angle_deg(equisolid.towards(200.0, 200.0 - 200.0 * part), up) ==
              Approx(2.0 * degrees(std::asin(part * std::sqrt(0.5)))).epsilon(1e-9));
    }
    CHECK(angle_deg(equisolid.towards(200.0, 200.0), up) < 1e-6);
}

TEST_CASE("pixels of an equisolid fisheye have equal solid angles", "[render][projection]") {
    const PixelRays rays = pixel_rays(upward(Projection::equisolid, 100));
    // The hemisphere's 2π over the circle's π 50² pixels.
    const double expected = 2.0 / 2500.0;
    for (const double column : {50.0, 60.0, 80.0, 95.0}) {
        CHECK(solid_angle(rays, column, 50.0) == Approx(expected).epsilon(1e-3));
    }
}

TEST_CASE("a panorama's columns are azimuths and its rows elevations", "[render][projection]") {
    Observer observer;
    observer.azimuth_deg = 90.0;
    observer.horizontal_fov_deg = 360.0;
    observer.width = 360;
    observer.height = 90;
    observer.projection = Projection::panorama;
    const PixelRays rays = pixel_rays(observer);
    CHECK(angle_deg(rays.towards(180.0, 45.0), direction(90.0, 0.0)) < 1e-6);
    CHECK(angle_deg(rays.towards(270.0, 45.0), direction(180.0, 0.0)) < 1e-6);
    CHECK(angle_deg(rays.towards(100.0, 15.0), direction(10.0, 30.0)) < 1e-6);
}

TEST_CASE("orthographic rays are parallel and start a pixel apart", "[render][projection]") {
    Observer observer;
    observer.azimuth_deg = 0.0;
    observer.elevation_deg = -90.0;
    observer.projection = Projection::orthographic;
    observer.picture_width = 128.0;
    observer.width = 64;
    observer.height = 32;
    const PixelRays rays = pixel_rays(observer);
    CHECK(rays.towards(0.0, 0.0) == rays.towards(64.0, 32.0));
    // Seen from above with north up: the upper left corner lies 64 m west and 32 m north.
    const Eigen::Vector3d corner = rays.start(0.0, 0.0);
    CHECK(corner.x() == Approx(-64.0));
    CHECK(corner.y() == Approx(32.0));
    CHECK((rays.start(11.0, 5.0) - rays.start(10.0, 5.0)).norm() == Approx(2.0));
    observer.picture_width = 0.0;
    CHECK_THROWS_AS(check_observer(observer), InputError);
}

// A square pit, as deep as wide, seen from the middle of its floor. The sky's share of the picture,
// weighted by cos θ over pixels of equal solid angle, is the floor point's sky view factor: four
// times that of a rectangle a x b over its corner at the height c (Howell, Catalog C-11),
// 1/2π [X/√(1+X²) atan(Y/√(1+X²)) + Y/√(1+Y²) atan(X/√(1+Y²))] with X = a/c, Y = b/c.
TEST_CASE("a hemispheric picture's weighted sky is the sky view factor", "[render][projection]") {
    FacetSet facets;
    const std::vector<Eigen::Vector3d> vertex = {{-5, -5, 0}, {5, -5, 0},   {5, 5, 0},
                                                 {-5, 5, 0},  {-5, -5, 10}, {5, -5, 10},
                                                 {5, 5, 10},  {-5, 5, 10}};
    const std::vector<std::array<std::uint32_t, 3>> triangle = {
        {0, 1, 2}, {0, 2, 3}, {0, 4, 5}, {0, 5, 1}, {1, 5, 6},
        {1, 6, 2}, {2, 6, 7}, {2, 7, 3}, {3, 7, 4}, {3, 4, 0}};
    append_facets(facets, vertex, triangle, std::vector<MaterialId>(triangle.size(), MaterialId{0}),
                  ObjectId{0});
    const RayScene scene(facets);
    Observer observer = upward(Projection::equisolid, 256);
    observer.position = {0.01, 0.02, 0.001};
    const View view = cast_view(scene, facets, observer);
    const PixelRays rays = pixel_rays(observer);
    double sky = 0.0, all = 0.0;
    for (int row = 0; row < 256; ++row) {
        for (int column = 0; column < 256; ++column) {
            const double cosine = rays.towards(column + 0.5, row + 0.5).z();
            if (cosine <= 0.0) continue;
            all += cosine;
            sky += cosine * double{view.sky[std::size_t(row) * 256 + std::size_t(column)]};
        }
    }
    const double x = 0.5, root = std::sqrt(1.0 + x * x);
    const double corner = 2.0 * x / root * std::atan(x / root) / (2.0 * std::numbers::pi);
    CHECK(sky / all == Approx(4.0 * corner).margin(5e-4));
    CHECK(4.0 * corner == Approx(0.2393).margin(1e-3));  // of a cube's wall seen from the middle
    // The floor's two facets: their mean is the factor of a cube's opposite face, 0.1998.
    double floor = 0.0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const FacetViews reference = facet_views(facets, scene, {.rays = 16384, .seed = seed});
        for (std::size_t f = 0; f < facets.size(); ++f) {
            if (facets.normal[f].z() > 0.9f) floor += 0.125 * double{reference.sky[f]};
        }
    }
    CHECK(floor == Approx(0.1998).margin(3e-3));
}

// From straight above, a square of 8 m x 6 m on the ground fills its share of a picture 20 m wide.
TEST_CASE("an orthographic picture keeps areas", "[render][projection]") {
    FacetSet facets;
    const std::vector<Eigen::Vector3d> ground = {
        {-50, -50, 0}, {50, -50, 0}, {50, 50, 0}, {-50, 50, 0}};
    const std::vector<Eigen::Vector3d> plate = {{1, 2, 5}, {9, 2, 5}, {9, 8, 5}, {1, 8, 5}};
    const std::vector<std::array<std::uint32_t, 3>> square = {{0, 1, 2}, {0, 2, 3}};
    const std::vector<MaterialId> material(2, MaterialId{0});
    append_facets(facets, ground, square, material, ObjectId{0});
    append_facets(facets, plate, square, material, ObjectId{1});
    const RayScene scene(facets);
    Observer observer;
    observer.position = {0.0, 0.0, 100.0};
    observer.elevation_deg = -90.0;
    observer.projection = Projection::orthographic;
    observer.picture_width = 20.0;
    observer.width = observer.height = 80;
    const View view = cast_view(scene, facets, observer);
    double seen = 0.0;
    for (const Sighting& s : view.sighting) {
        if (facets.object[index(view.surface[s.target])] == ObjectId{1}) seen += double{s.weight};
    }
    CHECK(seen / (80.0 * 80.0) == Approx(48.0 / 400.0).margin(1e-3));
    // Its middle lies 5 m east and north of the axis: 20 pixels right and up.
    CHECK(facets.object[index(view.centre[(40 - 20) * 80 + 60])] == ObjectId{1});
    CHECK(view.centre_range[(40 - 20) * 80 + 60] == Approx(95.0f));
    CHECK(view.centre_range[70 * 80 + 10] == Approx(100.0f));
}
