#include "render/view/place_in_picture.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

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

/// The half-space of points with normal · (point − eye) ≥ least.
struct HalfSpace {
    Eigen::Vector3d normal;
    double least = 0.0;
    double beyond(const Eigen::Vector3d& away) const { return away.dot(normal) - least; }
};

/// In front of a pinhole or an orthographic camera; of a pinhole also as far from its axis as boxes
/// reach (projected_box). Empty for other cameras.
std::vector<HalfSpace> in_front(const Observer& observer, const PixelRays& eye) {
    constexpr double widest = 80.0 * std::numbers::pi / 180.0;
    if (!eye.flat && eye.projection != Projection::orthographic) return {};
    std::vector<HalfSpace> all{{eye.axis, 1.01 * nearest_to_eye}};
    if (!eye.flat) return all;
    const double corner = 0.5 * std::hypot(observer.width, observer.height) * eye.column.norm();
    const double reach = std::max(std::tan(widest), 2.0 * corner);
    for (const Eigen::Vector3d& side : {eye.right, eye.down}) {
        all.push_back({reach * eye.axis - side});
        all.push_back({reach * eye.axis + side});
    }
    return all;
}

/// The part of a convex polygon in a half-space (Sutherland and Hodgman 1974).
std::vector<Eigen::Vector3d> clipped(const std::vector<Eigen::Vector3d>& corner,
                                     const HalfSpace& space) {
    std::vector<Eigen::Vector3d> kept;
    for (std::size_t i = 0; i < corner.size(); ++i) {
        const Eigen::Vector3d &a = corner[i], &b = corner[(i + 1) % corner.size()];
        const double at_a = space.beyond(a), at_b = space.beyond(b);
        if (at_a >= 0.0) kept.push_back(a);
        if ((at_a < 0.0) != (at_b < 0.0)) kept.push_back(a + at_a / (at_a - at_b) * (b - a));
    }
    return kept;
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
    const std::vector<HalfSpace> front = in_front(observer, eye);
    const double half_turn = std::numbers::pi / eye.per_pixel;  // of a panorama [pixels]
    bool over_seam = false;
    for (const std::uint32_t f : facet) {
        std::vector<Eigen::Vector3d> corner;  // from the eye
        for (const std::uint32_t v : facets.corner[f]) {
            corner.push_back(facets.vertex[v].cast<double>() - observer.position);
        }
        for (const HalfSpace& space : front) corner = clipped(corner, space);
        std::vector<std::optional<Eigen::Vector2d>> seen;
        for (const Eigen::Vector3d& away : corner) seen.push_back(extend(observer.position + away));
        if (!front.empty()) continue;
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
