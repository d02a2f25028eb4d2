#include "render/view/pixel_rays.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

Eigen::Vector3d PixelRays::still(double at_column, double at_row) const {
    if (flat) return (corner + at_column * column + at_row * row).normalized();
    if (projection == Projection::orthographic) return axis;
    const double x = (at_column - middle_column) * per_pixel;
    const double y = (at_row - middle_row) * per_pixel;
    if (projection == Projection::panorama) {
        return std::cos(y) * (std::cos(x) * axis + std::sin(x) * right) + std::sin(y) * down;
    }
    const double r = std::hypot(x, y);
    if (r < 1e-12) return axis;
    const double angle = fisheye_angle(projection, r);
    return std::cos(angle) * axis + std::sin(angle) / r * (x * right + y * down);
}

Eigen::Vector3d PixelRays::towards(double at_column, double at_row, double when) const {
    const Eigen::Vector3d direction = still(at_column, at_row);
    return turns ? turned(direction, at_row, when) : direction;
}

Eigen::Vector3d PixelRays::turned_back(const Eigen::Vector3d& direction, double at_row) const {
    const Eigen::Vector3d turn = std::floor(at_row) * row_turn;
    const double angle = turn.norm();
    if (!(angle > 0.0)) return direction;
    return Eigen::AngleAxisd(-angle, turn / angle) * direction;
}

Eigen::Vector3d PixelRays::turned(const Eigen::Vector3d& direction, double at_row,
                                  double when) const {
    const Eigen::Vector3d turn = std::floor(at_row) * row_turn + (when - 0.5) * exposure_turn;
    const double angle = turn.norm();
    if (!(angle > 0.0)) return direction;
    return Eigen::AngleAxisd(angle, turn / angle) * direction;
}

Eigen::Vector3d PixelRays::start(double at_column, double at_row, double when) const {
    const Eigen::Vector3d way = std::floor(at_row) * row_way + (when - 0.5) * exposure_way;
    if (projection != Projection::orthographic) return way;
    return way + per_pixel * ((at_column - middle_column) * right + (at_row - middle_row) * down);
}

double exposed(std::size_t sample, double offset) {
    const double turns = double(sample) * (std::numbers::phi - 1.0) + offset;
    return turns - std::floor(turns);
}

namespace {

/// From the picture's left edge to the right in the unit of PixelRays::per_pixel.
double picture_across(const Observer& observer) {
    const double fov = radians(observer.horizontal_fov_deg);
    if (observer.projection == Projection::orthographic) return observer.picture_width;
    if (!is_fisheye(observer.projection)) return fov;
    return 2.0 * fisheye_radius(observer.projection, 0.5 * fov);
}

}  // namespace

PixelRays pixel_rays(const Observer& observer) {
    const Eigen::Vector3d axis = direction(observer.azimuth_deg, observer.elevation_deg);
    const double azimuth = radians(observer.azimuth_deg);
    const Eigen::Vector3d level_right(std::cos(azimuth), -std::sin(azimuth), 0.0);
    const Eigen::Vector3d level_down = axis.cross(level_right);
    const double roll = radians(observer.roll_deg);
    const Eigen::Vector3d right = std::cos(roll) * level_right + std::sin(roll) * level_down;
    const Eigen::Vector3d down = std::cos(roll) * level_down - std::sin(roll) * level_right;
    PixelRays rays{.corner = axis,
                   .column = Eigen::Vector3d::Zero(),
                   .row = Eigen::Vector3d::Zero(),
                   .flat = observer.projection == Projection::pinhole,
                   .projection = observer.projection,
                   .axis = axis,
                   .right = right,
                   .down = down,
                   .middle_column = 0.5 * observer.width,
                   .middle_row = 0.5 * observer.height,
                   .row_way = observer.row_time * observer.velocity,
                   .exposure_way = observer.exposure * observer.velocity,
                   .row_turn = observer.row_time * observer.turning,
                   .exposure_turn = observer.exposure * observer.turning,
                   .turns = observer.turns()};
    if (rays.flat) {
        const double pitch =
            2.0 * std::tan(0.5 * radians(observer.horizontal_fov_deg)) / observer.width;
        rays.corner = axis - 0.5 * pitch * (observer.width * right + observer.height * down);
        rays.column = pitch * right;
        rays.row = pitch * down;
    } else {
        rays.per_pixel = picture_across(observer) / observer.width;
    }
    return rays;
}

double sample_angle(const Observer& observer, int samples) {
    const double root = std::sqrt(double(samples));
    if (observer.projection == Projection::orthographic) {
        return observer.picture_width / observer.width / root;
    }
    const PixelRays eye = pixel_rays(observer);
    const double column = 0.5 * observer.width, row = 0.5 * observer.height;
    return (eye.towards(column + 1.0, row) - eye.towards(column, row)).norm() / root;
}

}  // namespace diurna
