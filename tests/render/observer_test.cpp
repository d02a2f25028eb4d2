#include "render/view/observer.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "render/view/pixel_rays.hpp"
#include "terrain/place/site.hpp"
#include "tests/support/render_scene.hpp"

using namespace diurna;

namespace {

double angle_deg(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return degrees(std::atan2(a.cross(b).norm(), a.dot(b)));
}

}  // namespace

TEST_CASE("the middle of the picture lies on the axis, its edges half the field off",
          "[render][observer]") {
    Observer observer;
    observer.azimuth_deg = GENERATE(0.0, 77.0, 200.0);
    observer.elevation_deg = GENERATE(-60.0, 0.0, 25.0);
    observer.roll_deg = GENERATE(0.0, 30.0);
    observer.horizontal_fov_deg = 30.0;
    const PixelRays rays = pixel_rays(observer);
    const Eigen::Vector3d axis = direction(observer.azimuth_deg, observer.elevation_deg);
    CHECK(angle_deg(rays.towards(320.0, 256.0), axis) < 1e-6);
    CHECK(angle_deg(rays.towards(0.0, 256.0), axis) == Approx(15.0));
    CHECK(angle_deg(rays.towards(640.0, 256.0), axis) == Approx(15.0));
    // Square pixels: the vertical half field is atan(512/640 · tan 15°).
    const double vertical = degrees(std::atan(0.8 * std::tan(radians(15.0))));
    CHECK(angle_deg(rays.towards(320.0, 0.0), axis) == Approx(vertical));
}

TEST_CASE("columns run to the right, rows downward, and a roll turns clockwise",
          "[render][observer]") {
    Observer observer;
    observer.azimuth_deg = 90.0;  // east: south is to the right
    const PixelRays level = pixel_rays(observer);
    CHECK(level.towards(640.0, 256.0).y() < -0.1);
    CHECK(std::abs(level.towards(640.0, 256.0).z()) < 1e-12);
    CHECK(level.towards(320.0, 0.0).z() > 0.1);
    observer.roll_deg = 90.0;  // the camera's right is now below
    CHECK(pixel_rays(observer).towards(640.0, 256.0).z() < -0.1);
}

TEST_CASE("an observer can be turned towards a place", "[render][observer]") {
    Observer observer;
    observer.position = {100.0, -50.0, 30.0};
    const Eigen::Vector3d target(-20.0, 400.0, 5.0);
    const Observer turned = looking_at(observer, target);
    const PixelRays rays = pixel_rays(turned);
    CHECK(angle_deg(rays.towards(320.0, 256.0), target - observer.position) < 1e-6);
    CHECK_THROWS_AS(looking_at(observer, observer.position), InputError);
}

TEST_CASE("a camera below the ground or inside an object is refused by its depth",
          "[render][observer][input]") {
    const FacetSet facets = testing::hilly_world();
    const RayScene scene(facets);
    Observer observer = testing::hilly_observer();
    CHECK_NOTHROW(check_observer(observer, facets, scene));
    // The middle of a diagonal is the mean of its ends.
    const double ground = 0.5 * (testing::hills(80.0, -80.0) + testing::hills(160.0, 0.0));
    observer.position = {120.0, -40.0, ground - 3.2};
    CHECK_THROWS_WITH(check_observer(observer, facets, scene),
                      Catch::Contains("3.2 m below the terrain"));
    observer.position.z() = ground + 0.1;
    CHECK_NOTHROW(check_observer(observer, facets, scene));
    observer.position = {0.0, 0.0, testing::hills(0.0, 0.0) + 4.0};
    CHECK_THROWS_WITH(check_observer(observer, facets, scene), Catch::Contains("inside object 1"));
}

TEST_CASE("every error of an invalid observer is reported", "[render][observer][input]") {
    Observer observer;
    observer.horizontal_fov_deg = 200.0;
    observer.width = 0;
    observer.elevation_deg = std::nan("");
    try {
        check_observer(observer);
        FAIL("accepted");
    } catch (const InputError& error) {
        CHECK(error.mistakes().size() == 3);
    }
}
