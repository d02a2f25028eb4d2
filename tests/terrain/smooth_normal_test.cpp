#include "terrain/relief/smooth_normal.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/support/even_field.hpp"

using namespace diurna;

namespace {

/// Heights of a function of east and north [m] on 41 x 41 posts.
template <class Height>
HeightField field_of(double step, Height height) {
    std::vector<float> up;
    for (int row = 0; row < 41; ++row) {
        for (int column = 0; column < 41; ++column) {
            up.push_back(static_cast<float>(height(step * column, -step * row)));
        }
    }
    return even_field(41, 41, up, step);
}

double degrees_apart(const Eigen::Vector3f& a, const Eigen::Vector3d& b) {
    return std::acos(std::min(1.0, a.cast<double>().dot(b.normalized()))) * 180.0 / 3.14159265;
}

}  // namespace

TEST_CASE("the smooth normal of a plane is the plane's", "[terrain][relief][by_closed_form]") {
    const HeightField plane = field_of(10.0, [](double x, double y) { return 0.3 * x - 0.2 * y; });
    for (const double east : {3.0, 77.7, 201.0, 399.0}) {
        const Eigen::Vector3f normal = smooth_normal(plane, {east, -0.8 * east});
        CHECK(degrees_apart(normal, {-0.3, 0.2, 1.0}) < 0.03);
    }
}

// z = x²/(2R) + y²/(2R): gradient (x, y)/R.
TEST_CASE("the smooth normal of a bowl is the gradient's between posts",
          "[terrain][relief][by_closed_form]") {
    const double radius = 500.0, middle = 200.0;
    const HeightField bowl = field_of(10.0, [=](double x, double y) {
        return ((x - middle) * (x - middle) + (y + middle) * (y + middle)) / (2.0 * radius);
    });
    double worst_triangle = 0.0;
    for (double east = 40.0; east < 360.0; east += 3.7) {
        const double north = -400.0 + 0.7 * east;
        const Eigen::Vector3d exact{-(east - middle) / radius, -(north + middle) / radius, 1.0};
        CAPTURE(east, north);
        CHECK(degrees_apart(smooth_normal(bowl, {east, north}), exact) < 0.05);
        // A triangle of the cell is up to 10 m / 500 m * 2 / 3 off: the test can tell them apart.
        const double cell = 10.0 * std::floor(east / 10.0) + 10.0 / 3.0;
        worst_triangle = std::max(worst_triangle, std::abs(cell - east) / radius * 57.3);
    }
    CHECK(worst_triangle > 0.5);
}
