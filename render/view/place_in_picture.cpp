#include "render/view/place_in_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace diurna {

namespace {

constexpr double nearest_to_eye = 0.01;  // [m] in front of a flat picture's eye

/// Of a point seen from where the eye is then.
std::optional<Eigen::Vector2d> place_of(const PixelRays& eye, const Eigen::Vector3d& away) {
    const double deep = away.dot(eye.axis), x = away.dot(eye.right), y = away.dot(eye.down);
    const Eigen::Vector2d middle(eye.middle_column, eye.middle_row);
    if (eye.flat) {
        if (deep < nearest_to_eye) return std::nullopt;
        return middle + Eigen::Vector2d(x, y) / (deep * eye.column.norm());
    }
    if (eye.projection == Projection::orthographic) {
        if (deep < nearest_to_eye) return std::nullopt;
        return middle + Eigen::Vector2d(x, y) / eye.per_pixel;
    }
    const double across = std::hypot(x, y), angle = std::atan2(across, deep);
    if (eye.projection == Projection::panorama) {
        const Eigen::Vector2d turn(std::atan2(x, deep), std::atan2(y, std::hypot(x, deep)));
        return middle + turn / eye.per_pixel;
    }
    if (across < 1e-12 * std::abs(deep)) {
        return deep > 0.0 ? std::optional(middle) : std::nullopt;
    }
    const double r = fisheye_radius(eye.projection, angle);
    return middle + Eigen::Vector2d(x, y) * (r / (across * eye.per_pixel));
}

}  // namespace

std::optional<Eigen::Vector2d> place_in_picture(const Observer& observer, const PixelRays& eye,
                                                const Eigen::Vector3d& point) {
    const Eigen::Vector3d away = point - observer.position;
    std::optional<Eigen::Vector2d> place = place_of(eye, away);
    if (eye.row_way.isZero() && eye.row_turn.isZero()) return place;
    // The row says where the camera was, and that which row it is: 8 times round settles it, as a
    // camera moves by far less than the range from a row to the next.
    for (int i = 0; i < 8 && place; ++i) {
        const double row = std::floor(place->y());
        const Eigen::Vector3d then = away - row * eye.row_way;
        place = place_of(eye, eye.row_turn.isZero() ? then : eye.turned_back(then, row));
    }
    return place;
}

std::optional<PictureBox> projected_box(const Observer& observer, const FacetSet& facets,
                                        std::span<const std::uint32_t> facet) {
    const PixelRays eye = pixel_rays(observer);
    std::optional<PictureBox> box;
    const auto extend = [&](const Eigen::Vector3d& point) {
        const std::optional<Eigen::Vector2d> at = place_in_picture(observer, eye, point);
        if (!at) return at;
        if (!box) box = PictureBox{at->x(), at->y(), at->x(), at->y()};
        box->left = std::min(box->left, at->x());
        box->top = std::min(box->top, at->y());
        box->right = std::max(box->right, at->x());
        box->bottom = std::max(box->bottom, at->y());
        return at;
    };
    const bool one_sided = eye.flat || eye.projection == Projection::orthographic;
    const double half_turn = std::numbers::pi / eye.per_pixel;  // of a panorama [pixels]
    bool over_seam = false;
    for (const std::uint32_t f : facet) {
        std::array<Eigen::Vector3d, 3> corner;
        std::array<double, 3> beyond;  // the nearest plane
        std::array<std::optional<Eigen::Vector2d>, 3> seen;
        for (std::size_t i = 0; i < 3; ++i) {
            corner[i] = facets.vertex[facets.corner[f][i]].cast<double>();
            beyond[i] = (corner[i] - observer.position).dot(eye.axis) - 1.01 * nearest_to_eye;
        }
        for (std::size_t i = 0; i < 3; ++i) {
            seen[i] = extend(corner[i]);
            const std::size_t j = (i + 1) % 3;
            if (!one_sided || (beyond[i] < 0.0) == (beyond[j] < 0.0)) continue;
            extend(corner[i] + beyond[i] / (beyond[i] - beyond[j]) * (corner[j] - corner[i]));
        }
        for (std::size_t i = 0; i < 3; ++i) {
            const auto &a = seen[i], &b = seen[(i + 1) % 3];
            over_seam = over_seam || (a && b && std::abs(a->x() - b->x()) > half_turn);
        }
    }
    // The shorter way from one corner to the other leads behind a panorama, across its seam.
    if (over_seam && eye.projection == Projection::panorama) {
        box->left = eye.middle_column - half_turn;
        box->right = eye.middle_column + half_turn;
    }
    return box;
}

}  // namespace diurna
