#include "terrain/ground/rings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace diurna {

namespace {

/// Distance [posts] within which a ring runs through a post instead of beside it, so that no sliver
/// arises: little to what is cut, too, where posts are far apart.
double snapping_distance(const Ring& ring, double largest_edge, const Eigen::Vector2d& spacing) {
    const RingExtent extent(ring);
    const double size = (extent.high - extent.low).cwiseProduct(spacing).minCoeff();
    return std::min(
        {0.005, 0.2 * largest_edge / spacing.maxCoeff(), 0.02 * size / spacing.maxCoeff()});
}

/// Posts within the snapping distance of the way from `a` to `b`, ends skipped, in order.
Ring posts_along(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double snap) {
    const Eigen::Vector2d way = b - a;
    const double length = way.norm();
    Ring found;
    const int axis = std::abs(way.x()) >= std::abs(way.y()) ? 0 : 1;
    const double first = std::min(a[axis], b[axis]), last = std::max(a[axis], b[axis]);
    for (double line = std::ceil(first); line <= last && length > 0.0; ++line) {
        const double t = (line - a[axis]) / way[axis];
        Eigen::Vector2d post;
        post[axis] = line;
        post[1 - axis] = std::round(a[1 - axis] + t * way[1 - axis]);
        const Eigen::Vector2d to = post - a;
        const double beside = std::abs(way.x() * to.y() - way.y() * to.x()) / length;
        if (beside < snap) found.push_back(post);
    }
    if (a[axis] > b[axis]) std::reverse(found.begin(), found.end());
    return found;
}

double distance_to_ring(const Ring& ring, const Eigen::Vector2d& p,
                        const Eigen::Vector2d& spacing) {
    double nearest_squared = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Eigen::Vector2d side = (ring[i] - ring[j]).cwiseProduct(spacing);
        const Eigen::Vector2d to = (p - ring[j]).cwiseProduct(spacing);
        const double t = std::clamp(to.dot(side) / side.squaredNorm(), 0.0, 1.0);
        nearest_squared = std::min(nearest_squared, (to - t * side).squaredNorm());
    }
    return std::sqrt(nearest_squared);
}

}  // namespace

RingExtent::RingExtent(const Ring& ring) : low(ring.front()), high(ring.front()) {
    for (const auto& p : ring) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
}

bool RingExtent::contains(const Eigen::Vector2d& p) const {
    return (p.array() >= low.array()).all() && (p.array() <= high.array()).all();
}

Ring clipped(Ring ring, int columns, int rows) {
    const Eigen::Vector2d high(columns - 1, rows - 1);
    // One side after the other (Sutherland & Hodgman 1974).
    for (int side = 0; side < 4; ++side) {
        const int axis = side / 2;
        const double limit = side % 2 == 0 ? 0.0 : high[axis];
        const auto inside = [&](const Eigen::Vector2d& p) {
            return side % 2 == 0 ? p[axis] >= limit : p[axis] <= limit;
        };
        Ring kept;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Eigen::Vector2d &from = ring[i], &to = ring[(i + 1) % ring.size()];
            if (inside(from)) kept.push_back(from);
            if (inside(from) == inside(to)) continue;
            Eigen::Vector2d crossing =
                from + (to - from) * ((limit - from[axis]) / (to[axis] - from[axis]));
            crossing[axis] = limit;
            kept.push_back(crossing);
        }
        ring = std::move(kept);
    }
    return ring;
}

Ring divided(const Ring& ring, double largest_edge, const Eigen::Vector2d& spacing) {
    Ring points;
    if (ring.empty()) return points;
    const double snap = snapping_distance(ring, largest_edge, spacing);
    const auto add = [&](Eigen::Vector2d p) {
        const Eigen::Vector2d post(std::round(p.x()), std::round(p.y()));
        if ((p - post).norm() < snap) p = post;
        if (points.empty() || (p - points.back()).norm() > snap) points.push_back(p);
    };
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector2d step = ring[(i + 1) % ring.size()] - ring[i];
        const double parts = std::ceil(step.cwiseProduct(spacing).norm() / largest_edge);
        const int count = std::max(1, static_cast<int>(parts));
        for (int k = 0; k < count; ++k) {
            const Eigen::Vector2d from = ring[i] + step * (k / double(count));
            add(from);
            for (const auto& post :
                 posts_along(from, ring[i] + step * ((k + 1) / double(count)), snap)) {
                add(post);
            }
        }
    }
    while (points.size() > 1 && (points.back() - points.front()).norm() <= snap) points.pop_back();
    return points;
}

bool contains(const Ring& ring, const Eigen::Vector2d& p) {
    bool inside = false;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Eigen::Vector2d &a = ring[i], &b = ring[j];
        if ((a.y() > p.y()) != (b.y() > p.y()) &&
            p.x() < a.x() + (p.y() - a.y()) * (b.x() - a.x()) / (b.y() - a.y())) {
            inside = !inside;
        }
    }
    return inside;
}

Ring lattice_inside(const Ring& corners, const Ring& border, double largest_edge,
                    const Eigen::Vector2d& spacing) {
    const double step = 0.75 * largest_edge;
    Eigen::Vector2d along = Eigen::Vector2d::UnitX();
    double longest = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Eigen::Vector2d side =
            (corners[(i + 1) % corners.size()] - corners[i]).cwiseProduct(spacing);
        if (side.norm() > longest) {
            longest = side.norm();
            along = side / longest;
        }
    }
    const Eigen::Vector2d across(-along.y(), along.x());
    const RingExtent extent(border);
    const Eigen::Vector2d centre = 0.5 * (extent.low + extent.high);
    const int reach = static_cast<int>(
        std::ceil(0.5 * (extent.high - extent.low).cwiseProduct(spacing).norm() / step));
    Ring points;
    for (int v = -reach; v <= reach; ++v) {
        for (int u = -reach; u <= reach; ++u) {
            const Eigen::Vector2d metres = step * (u * along + v * across);
            const Eigen::Vector2d p = centre + metres.cwiseQuotient(spacing);
            if (extent.contains(p) && contains(border, p) &&
                distance_to_ring(border, p, spacing) > 0.5 * step) {
                points.push_back(p);
            }
        }
    }
    return points;
}

Ring counterclockwise(const Ring& given) {
    Ring ring;
    for (const auto& p : given) {
        if (ring.empty() || (p - ring.back()).norm() > 1e-4) ring.push_back(p);
    }
    while (ring.size() > 1 && (ring.front() - ring.back()).norm() <= 1e-4) ring.pop_back();
    double area = 0.0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) area += turn(ring[0], ring[i], ring[i + 1]);
    if (area < 0.0) std::reverse(ring.begin(), ring.end());
    return ring;
}

Ring widened(const Ring& ring, double distance) {
    const std::size_t n = ring.size();
    const auto outward = [&](std::size_t side) -> Eigen::Vector2d {
        const Eigen::Vector2d along = (ring[(side + 1) % n] - ring[side]).normalized();
        return {along.y(), -along.x()};
    };
    Ring wide;
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector2d middle = outward((i + n - 1) % n) + outward(i);
        const double most = std::max(middle.squaredNorm(), middle.norm());
        wide.push_back(ring[i] + (most > 0.0 ? Eigen::Vector2d(2.0 * distance / most * middle)
                                             : Eigen::Vector2d(distance * outward(i))));
    }
    return wide;
}

Ring ribbon(std::span<const Eigen::Vector2d> line, double width) {
    std::vector<Eigen::Vector2d> way;
    for (const auto& p : line) {
        if (way.empty() || (p - way.back()).norm() > 1e-6) way.push_back(p);
    }
    if (way.size() < 2) return {};
    Ring left, right;
    const auto side = [&](std::size_t i) -> Eigen::Vector2d {
        const Eigen::Vector2d along = (way[i + 1] - way[i]).normalized();
        return {-along.y(), along.x()};
    };
    for (std::size_t i = 0; i < way.size(); ++i) {
        const Eigen::Vector2d before = side(i > 0 ? i - 1 : 0);
        const Eigen::Vector2d after = side(std::min(i, way.size() - 2));
        const Eigen::Vector2d middle = before + after;
        // The mitre reaches 1/cos of half the bend.
        const double reach = middle.norm() > 1.0 ? 2.0 / middle.squaredNorm() : 1.0;
        const Eigen::Vector2d off =
            0.5 * width * (middle.norm() > 1.0 ? Eigen::Vector2d(reach * middle) : after);
        left.push_back(way[i] + off);
        right.push_back(way[i] - off);
    }
    left.insert(left.end(), right.rbegin(), right.rend());
    return left;
}

}  // namespace diurna
