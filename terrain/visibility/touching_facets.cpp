#include "terrain/visibility/touching_facets.hpp"

#include <Eigen/Geometry>
#include <array>
#include <cmath>

namespace diurna {

namespace {

using Bounds = Eigen::AlignedBox3d;
using Polygon = std::vector<Eigen::Vector3d>;  // east and north of a plane, height over it

std::array<Eigen::Vector3d, 3> corners_of(const FacetSet& facets, std::uint32_t f) {
    std::array<Eigen::Vector3d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
        corner[k] = facets.vertex[facets.corner[f][k]].cast<double>();
    }
    return corner;
}
Bounds box_of(const FacetSet& facets, std::uint32_t f) {
    Bounds box;
    for (const Eigen::Vector3d& corner : corners_of(facets, f)) box.extend(corner);
    return box;
}

/// What of a polygon lies to the left of the way from one point to another (Sutherland & Hodgman).
Polygon left_of(const Polygon& polygon, const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const Eigen::Vector2d way = to - from;
    const auto side = [&](const Eigen::Vector3d& p) {
        return way.x() * (p.y() - from.y()) - way.y() * (p.x() - from.x());
    };
    Polygon kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Eigen::Vector3d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        const double at_p = side(p), at_q = side(q);
        if (at_p >= 0.0) kept.push_back(p);
        if ((at_p > 0.0) != (at_q > 0.0) && at_p != at_q && at_p * at_q < 0.0) {
            kept.emplace_back(p + at_p / (at_p - at_q) * (q - p));
        }
    }
    return kept;
}

double area_of(const Polygon& polygon) {
    double twice = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Eigen::Vector3d &p = polygon[k], &q = polygon[(k + 1) % polygon.size()];
        twice += p.x() * q.y() - p.y() * q.x();
    }
    return 0.5 * std::abs(twice);
}

double overlap_of(const FacetSet& facets, std::uint32_t a, std::uint32_t b, double gap) {
    const auto corner = corners_of(facets, a);
    Eigen::Matrix3d frame;
    frame.row(0) = (corner[1] - corner[0]).normalized();
    frame.row(2) = (corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized();
    frame.row(1) = frame.row(2).cross(frame.row(0));
    Polygon polygon;
    for (const Eigen::Vector3d& p : corners_of(facets, b)) {
        polygon.emplace_back(frame * (p - corner[0]));
    }
    for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) {
        const Eigen::Vector3d from = frame * (corner[k] - corner[0]),
                              to = frame * (corner[(k + 1) % 3] - corner[0]);
        polygon = left_of(polygon, from.head<2>(), to.head<2>());
    }
    if (polygon.size() < 3) return 0.0;
    double height = 0.0;
    for (const Eigen::Vector3d& p : polygon) height += p.z() / double(polygon.size());
    return std::abs(height) <= gap ? area_of(polygon) : 0.0;
}

}  // namespace

std::vector<TouchingFacets> touching_facets(const FacetSet& facets,
                                            std::span<const std::uint32_t> a,
                                            std::span<const std::uint32_t> b, double gap) {
    constexpr float opposed = -0.7f;
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(gap);
    const auto grown = [&](std::uint32_t f) {
        const Bounds box = box_of(facets, f);
        return Bounds(box.min() - margin, box.max() + margin);
    };
    Bounds whole;
    for (const std::uint32_t f : a) whole.extend(grown(f));
    std::vector<std::uint32_t> near;
    std::vector<Bounds> box;
    for (const std::uint32_t f : b) {
        const Bounds own = box_of(facets, f);
        if (!whole.intersects(own)) continue;
        near.push_back(f);
        box.push_back(own);
    }
    std::vector<TouchingFacets> touching;
    for (const std::uint32_t f : a) {
        const Bounds reach = grown(f);
        for (std::size_t k = 0; k < near.size(); ++k) {
            if (near[k] == f || !reach.intersects(box[k])) continue;
            if (facets.normal[f].dot(facets.normal[near[k]]) > opposed) continue;
            const double area = overlap_of(facets, f, near[k], gap);
            if (area > 1e-6 * double(facets.area[f])) touching.push_back({f, near[k], area});
        }
    }
    return touching;
}

}  // namespace diurna
