#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "render/view/cast_view.hpp"
#include "render/view/view.hpp"

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
    bool west(FacetId facet) const { return facets.object[index(facet)] == ObjectId{0}; }

    /// (row)(column) Share of each pixel that sees the western half.
    std::vector<std::vector<double>> western(int samples) const {
        const View view = cast_view(RayScene(facets), facets, observer, {.samples = samples});
        std::vector<std::vector<double>> share(32, std::vector<double>(64, 0.0));
        for (std::size_t p = 0; p < view.pixels(); ++p) {
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                if (west(view.facet[s.target])) share[p / 64][p % 64] += double{s.weight};
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
        CHECK(floor.west(view.centre[64 * row + border - 1]));
        CHECK_FALSE(floor.west(view.centre[64 * row + border]));
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

TEST_CASE("a camera's motion has its range", "[render][motion][input]") {
    Floor floor;
    floor.observer.exposure = -1.0;
    CHECK_THROWS_AS(check_observer(floor.observer), InputError);
    floor.observer.exposure = 0.0;
    floor.observer.velocity.y() = std::nan("");
    CHECK_THROWS_AS(check_observer(floor.observer), InputError);
}
