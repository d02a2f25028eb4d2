#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "render/view/cast_view.hpp"
#include "render/view/pixel_rays.hpp"
#include "render/view/place_in_picture.hpp"
#include "render/view/view.hpp"
#include "terrain/place/trajectory.hpp"

// Straight down on a floor whose western and eastern half are two objects: a pixel is a metre, and
// the border stands in the middle of the picture while the camera stands over it.

using namespace diurna;

namespace {

struct Floor {
    FacetSet facets;
    Observer observer;

    Floor() {
        const std::vector<std::array<std::uint32_t, 3>> square = {{0, 1, 2}, {0, 2, 3}};
        const std::vector<MaterialId> material(2, MaterialId{0});
        for (const double west : {-200.0, 0.0}) {
            const double east = west + 200.0;
            const std::vector<Eigen::Vector3d> vertex = {
                {west, -200, 0}, {east, -200, 0}, {east, 200, 0}, {west, 200, 0}};
            append_facets(facets, vertex, square, material, west < 0.0 ? ObjectId{0} : ObjectId{1});
        }
        observer.position = {0.0, 0.0, 100.0};
        observer.elevation_deg = -90.0;
        observer.width = 64;
        observer.height = 32;
        observer.horizontal_fov_deg = 2.0 * degrees(std::atan(0.32));
    }
    bool west(SurfaceId facet) const { return facets.object[index(facet)] == ObjectId{0}; }

    /// (row)(column) Share of each pixel that sees the western half.
    std::vector<std::vector<double>> western(int samples) const {
        const View view = cast_view(RayScene(facets), facets, observer, {.samples = samples});
        std::vector<std::vector<double>> share(32, std::vector<double>(64, 0.0));
        for (std::size_t p = 0; p < view.pixels(); ++p) {
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                if (west(view.surface[s.target])) share[p / 64][p % 64] += double{s.weight};
            }
        }
        return share;
    }
};

}  // namespace

TEST_CASE("rows read one after the other shear what a moving camera sees", "[render][motion]") {
    Floor floor;
    floor.observer.velocity = {7.3, 1.0, 0.0};
    floor.observer.row_time = 0.1;
    const auto share = floor.western(576);
    for (std::size_t row = 0; row < 32; ++row) {
        double columns = 0.0;
        for (const double s : share[row]) columns += s;
        CAPTURE(row);
        // The camera has gone 0.73 m further east with every row. Of 24 x 24 samples the 24 in
        // cells that the border parts are by chance on either side: 0.004 pixels, and 5 of those.
        CHECK(columns == Approx(32.0 - 0.73 * double(row)).margin(0.02));
    }
    // Truth is that of pixels' middles at the same instants.
    const View view = cast_view(RayScene(floor.facets), floor.facets, floor.observer);
    for (std::size_t row = 0; row < 32; ++row) {
        const auto border = static_cast<std::size_t>(std::lround(32.0 - 0.73 * double(row)));
        CHECK(floor.west(own_surface(view.centre[64 * row + border - 1])));
        CHECK_FALSE(floor.west(own_surface(view.centre[64 * row + border])));
    }
    // A climb of 1 m a row makes pixels larger, and the border comes nearer to the middle.
    floor.observer.velocity = {0.0, 0.0, 10.0};
    floor.observer.position.x() = 20.0;
    const auto climbed = floor.western(576);
    for (const std::size_t row : {0u, 15u, 31u}) {
        double columns = 0.0;
        for (const double s : climbed[row]) columns += s;
        CHECK(columns == Approx(32.0 - 20.0 / (1.0 + 0.01 * double(row))).margin(0.02));
    }
}

TEST_CASE("an edge blurs to the width a camera moves in its exposure", "[render][motion]") {
    Floor floor;
    floor.observer.velocity = {10.0, 0.0, 0.0};
    floor.observer.exposure = 1.2;
    const auto share = floor.western(256);
    double worst = 0.0;
    for (std::size_t row = 0; row < 32; ++row) {
        for (std::size_t column = 0; column < 64; ++column) {
            // The mean of the border's places, even over 12 pixels from 26 to 38, in the pixel.
            const double middle = double(column) + 0.5;
            const double expected = std::clamp((38.0 - middle) / 12.0, 0.0, 1.0);
            worst = std::max(worst, std::abs(share[row][column] - expected));
        }
    }
    CAPTURE(worst);
    CHECK(worst < 0.02);
    // Nothing is blurred without a way.
    floor.observer.velocity = {0.0, 0.0, 0.0};
    CHECK(floor.western(16)[5][31] == Approx(1.0));
    CHECK(floor.western(16)[5][32] == Approx(0.0));
}

TEST_CASE("a turning camera's rows and exposures turn with it", "[render][motion]") {
    // About the axis to the north by 0.3 degrees a row: the camera looks further west with each,
    // and the border, 100 m below, goes to tan of the angle of the 100 pixels to a radian.
    Floor floor;
    floor.observer.turning = {0.0, radians(3.0), 0.0};
    floor.observer.row_time = 0.1;
    const auto rows = floor.western(576);
    for (std::size_t row = 0; row < 32; ++row) {
        double columns = 0.0;
        for (const double s : rows[row]) columns += s;
        CAPTURE(row);
        CHECK(columns == Approx(32.0 + 100.0 * std::tan(radians(0.3 * double(row)))).margin(0.02));
    }
    // And a point of the ground is where the row that sees it finds it.
    const PixelRays eye = pixel_rays(floor.observer);
    const auto place = place_in_picture(floor.observer, eye, {0.0, -3.5, 0.0});
    REQUIRE(place);
    const double row = std::floor(place->y());
    CHECK(row == 19.0);
    CHECK(place->x() == Approx(32.0 + 100.0 * std::tan(radians(0.3 * row))).margin(1e-6));

    // In an exposure it turns 12 pixels' worth of angle, from 6 before to 6 behind.
    floor.observer.row_time = 0.0;
    floor.observer.exposure = 0.5;
    floor.observer.turning = {0.0, 2.0 * std::atan(0.12), 0.0};
    const auto blurred = floor.western(256);
    const double half = 0.5 * std::atan(0.12);
    double worst = 0.0;
    for (std::size_t column = 0; column < 64; ++column) {
        // The border's angle runs evenly from -half to half.
        const double angle = std::atan((double(column) + 0.5 - 32.0) / 100.0);
        const double expected = std::clamp((half - angle) / (2.0 * half), 0.0, 1.0);
        worst = std::max(worst, std::abs(blurred[16][column] - expected));
    }
    CAPTURE(worst);
    CHECK(worst < 0.03);
}

TEST_CASE("a camera turned to an attitude has its angles", "[render][motion]") {
    for (const auto& [azimuth, elevation, roll] :
         {std::array{45.0, -20.0, 0.0}, {300.0, 35.0, -70.0}, {180.0, 0.0, 160.0}}) {
        const Observer turned = turned_to({}, attitude(azimuth, elevation, roll));
        CHECK(turned.azimuth_deg == Approx(azimuth));
        CHECK(turned.elevation_deg == Approx(elevation).margin(1e-9));
        CHECK(turned.roll_deg == Approx(roll).margin(1e-9));
        // The picture's right, down and forward are the body's right, down and forward.
        const PixelRays eye = pixel_rays(turned);
        const Eigen::Matrix3d axes = attitude(azimuth, elevation, roll).toRotationMatrix();
        CHECK((eye.right - axes.col(0)).norm() < 1e-9);
        CHECK((eye.axis - axes.col(1)).norm() < 1e-9);
        CHECK((eye.down + axes.col(2)).norm() < 1e-9);
    }
    // Straight down from a body that heads east: the upper edge looks east.
    const Observer down = turned_to({}, attitude(90.0, -90.0, 0.0));
    CHECK(down.azimuth_deg == Approx(90.0));
    CHECK(down.elevation_deg == Approx(-90.0));
    CHECK((pixel_rays(down).down - Eigen::Vector3d(-1, 0, 0)).norm() < 1e-9);
}

TEST_CASE("a camera's motion has its range", "[render][motion][input]") {
    Floor floor;
    floor.observer.exposure = -1.0;
    CHECK_THROWS_AS(check_observer(floor.observer), InputError);
    floor.observer.exposure = 0.0;
    floor.observer.velocity.y() = std::nan("");
    CHECK_THROWS_AS(check_observer(floor.observer), InputError);
}
