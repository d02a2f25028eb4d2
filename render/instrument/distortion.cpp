#include "render/instrument/distortion.hpp"

#include <fmt/format.h>

#include <Eigen/LU>

#include "materials/base/error.hpp"

namespace diurna {

bool distorts(const Lens& lens) {
    return lens.k1 != 0.0 || lens.k2 != 0.0 || lens.k3 != 0.0 || lens.p1 != 0.0 || lens.p2 != 0.0;
}

Eigen::Vector2d distorted(const Lens& lens, const Eigen::Vector2d& place) {
    const double x = place.x(), y = place.y(), r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
    return {x * radial + 2.0 * lens.p1 * x * y + lens.p2 * (r2 + 2.0 * x * x),
            y * radial + lens.p1 * (r2 + 2.0 * y * y) + 2.0 * lens.p2 * x * y};
}

namespace {

Eigen::Matrix2d slope(const Lens& lens, const Eigen::Vector2d& place) {
    const double x = place.x(), y = place.y(), r2 = x * x + y * y;
    const double radial = 1.0 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
    const double by_r2 = lens.k1 + r2 * (2.0 * lens.k2 + r2 * 3.0 * lens.k3);
    Eigen::Matrix2d m;
    m(0, 0) = radial + 2.0 * x * x * by_r2 + 2.0 * lens.p1 * y + 6.0 * lens.p2 * x;
    m(0, 1) = 2.0 * x * y * by_r2 + 2.0 * lens.p1 * x + 2.0 * lens.p2 * y;
    m(1, 0) = m(0, 1);
    m(1, 1) = radial + 2.0 * y * y * by_r2 + 6.0 * lens.p1 * y + 2.0 * lens.p2 * x;
    return m;
}

}  // namespace

Eigen::Vector2d undistorted(const Lens& lens, const Eigen::Vector2d& place) {
    Eigen::Vector2d found = place;
    for (int i = 0; i < 30; ++i) {
        const Eigen::Matrix2d m = slope(lens, found);
        if (!(m.determinant() > 0.05)) break;
        const Eigen::Vector2d step = m.inverse() * (place - distorted(lens, found));
        found += step;
        if (!(step.norm() < 1e3)) break;
        if (step.norm() < 1e-13) return found;
    }
    throw InputError(
        "distortion",
        fmt::format("the lens distortion is not unique at {:.3g}, {:.3g} focal lengths from the "
                    "axis: no direction maps to that place of the picture",
                    place.x(), place.y()));
}

}  // namespace diurna
