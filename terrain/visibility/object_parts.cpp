#include "terrain/visibility/object_parts.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace diurna {

namespace {

const double even = std::cos(20.0 * std::numbers::pi / 180.0);

/// Sets that grow together (union-find).
class Sets {
 public:
    explicit Sets(std::size_t members) : up_(members) { std::iota(up_.begin(), up_.end(), 0u); }
    std::uint32_t of(std::uint32_t m) {
        while (up_[m] != m) m = up_[m] = up_[up_[m]];
        return m;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = of(a);
        b = of(b);
        up_[std::max(a, b)] = std::min(a, b);
    }

 private:
    std::vector<std::uint32_t> up_;
};

/// The facets of objects, counted from the first of them, and the places of their corners.
struct PartCorners {
    const FacetSet& facets;
    std::size_t first;
    std::vector<std::array<std::uint32_t, 3>> place;  // (facet)

    PartCorners(const FacetSet& all, std::size_t begin) : facets(all), first(begin) {
        std::map<std::array<float, 3>, std::uint32_t> known;
        for (std::size_t f = first; f < facets.size(); ++f) {
            auto& places = place.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                const Eigen::Vector3f& v = facets.vertex[facets.corner[f][k]];
                const auto number = static_cast<std::uint32_t>(known.size());
                places[k] = known.try_emplace({v.x(), v.y(), v.z()}, number).first->second;
            }
        }
    }
    std::size_t size() const { return place.size(); }
    Eigen::Vector3d normal(std::size_t f) const { return facets.normal[first + f].cast<double>(); }
    double area(std::size_t f) const { return facets.area[first + f]; }
    std::array<Eigen::Vector3d, 3> triangle(std::size_t f) const {
        const auto& corner = facets.corner[first + f];
        return {facets.vertex[corner[0]].cast<double>(), facets.vertex[corner[1]].cast<double>(),
                facets.vertex[corner[2]].cast<double>()};
    }
};

/// Facets of one object that share an edge and lie even (`flat`), or that share a corner.
std::vector<std::uint32_t> connected(const PartCorners& corners, bool flat) {
    Sets sets(corners.size());
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> last;  // object and places -> facet
    for (std::uint32_t f = 0; f < corners.size(); ++f) {
        const auto object = static_cast<std::uint32_t>(corners.facets.object[corners.first + f]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = corners.place[f][k];
            const std::uint32_t b = flat ? corners.place[f][(k + 1) % 3] : a;
            const auto [known, is_new] =
                last.try_emplace({object, std::min(a, b), std::max(a, b)}, f);
            if (is_new) continue;
            if (!flat || corners.normal(f).dot(corners.normal(known->second)) > even) {
                sets.join(f, known->second);
            }
            if (flat) known->second = f;
        }
    }
    std::vector<std::uint32_t> set(corners.size());
    for (std::uint32_t f = 0; f < corners.size(); ++f) set[f] = sets.of(f);
    return set;
}

/// The facets of each set, in their order.
std::map<std::uint32_t, std::vector<std::uint32_t>> members(const std::vector<std::uint32_t>& set) {
    std::map<std::uint32_t, std::vector<std::uint32_t>> facets;
    for (std::uint32_t f = 0; f < set.size(); ++f) facets[set[f]].push_back(f);
    return facets;
}

/// From least to most along an axis.
std::pair<double, double> extent(const PartCorners& corners,
                                 const std::vector<std::uint32_t>& facets,
                                 const Eigen::Vector3d& axis) {
    double least = 1e300, most = -1e300;
    for (const std::uint32_t f : facets) {
        for (const Eigen::Vector3d& v : corners.triangle(f)) {
            least = std::min(least, v.dot(axis));
            most = std::max(most, v.dot(axis));
        }
    }
    return {least, most};
}

/// The longer side of the least rectangle about some facets, as seen along `from`; a unit vector.
/// One of its sides lies along an edge.
Eigen::Vector3d longer_side(const PartCorners& corners, const std::vector<std::uint32_t>& facets,
                            const Eigen::Vector3d& from) {
    const Eigen::Vector3d east = from.unitOrthogonal(), north = from.cross(east);
    constexpr double fine = 1000.0;  // directions to a radian
    std::set<long> tried;
    double least = 1e300;
    Eigen::Vector3d side = east;
    for (const std::uint32_t f : facets) {
        const auto triangle = corners.triangle(f);
        for (std::size_t k = 0; k < 3; ++k) {
            const Eigen::Vector3d edge = triangle[(k + 1) % 3] - triangle[k];
            const double x = edge.dot(east), y = edge.dot(north);
            if (std::hypot(x, y) < 1e-6) continue;
            const double angle = std::atan2(y, x);
            const double quarter =
                angle - 0.5 * std::numbers::pi * std::floor(angle / (0.5 * std::numbers::pi));
            if (!tried.insert(std::lround(fine * quarter)).second) continue;
            const Eigen::Vector3d one = (x * east + y * north).normalized();
            const Eigen::Vector3d other = from.cross(one);
            const auto [a, b] = extent(corners, facets, one);
            const auto [c, d] = extent(corners, facets, other);
            if ((b - a) * (d - c) < least * (1.0 - 1e-6)) {
                least = (b - a) * (d - c);
                side = b - a >= d - c ? one : other;
            }
        }
    }
    return side;
}

void measure_even_part(const PartCorners& corners, const std::vector<std::uint32_t>& facets,
                       std::vector<PartSize>& size) {
    constexpr double level = 0.98;  // cosine of a slope without an up of its own
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    double area = 0.0;
    for (const std::uint32_t f : facets) {
        normal += corners.area(f) * corners.normal(f);
        area += corners.area(f);
    }
    // A strip all around a pipe has no side of its own.
    normal = normal.norm() > 1e-3 * area ? normal.normalized() : Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d across = std::abs(normal.z()) < level
                                       ? Eigen::Vector3d::UnitZ().cross(normal).normalized()
                                       : longer_side(corners, facets, normal);
    const Eigen::Vector3d up = normal.cross(across);
    const auto [left, right] = extent(corners, facets, across);
    const auto [low, high] = extent(corners, facets, up);
    const double breadth = area / (2.0 * (right - left + high - low));
    for (const std::uint32_t f : facets) {
        size[f].rise = float(high - low);
        size[f].breadth = float(breadth);
        size[f].chord = float(std::numbers::pi * breadth);
    }
}

BodyBox measure_body(const PartCorners& corners, const std::vector<std::uint32_t>& facets,
                     std::vector<PartSize>& size, std::uint32_t body) {
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d along = longer_side(corners, facets, up), across = up.cross(along);
    const auto [back, front] = extent(corners, facets, along);
    const auto [right, left] = extent(corners, facets, across);
    const auto [bottom, top] = extent(corners, facets, up);
    std::array<double, 3> extents{front - back, left - right, top - bottom};
    std::sort(extents.begin(), extents.end());
    constexpr double thinnest = 1e-3;  // [m] of sheets
    const double width = std::sqrt(std::max(extents[0], thinnest) * extents[1]);
    for (const std::uint32_t f : facets) {
        size[f].across = float(width);
        size[f].body = body;
    }
    const Eigen::Vector3d middle = 0.5 * ((back + front) * along + (right + left) * across);
    return {.middle = middle.head<2>(),
            .along = along.head<2>(),
            .half_length = 0.5 * (front - back),
            .half_width = 0.5 * (left - right),
            .bottom = bottom,
            .top = top};
}

}  // namespace

ObjectBodies object_parts(const FacetSet& facets, std::size_t first) {
    const PartCorners corners(facets, first);
    ObjectBodies parts{.first = first, .size = std::vector<PartSize>(corners.size()), .body = {}};
    for (const auto& [root, part] : members(connected(corners, true))) {
        measure_even_part(corners, part, parts.size);
    }
    for (const auto& [root, body] : members(connected(corners, false))) {
        parts.body.push_back(
            measure_body(corners, body, parts.size, static_cast<std::uint32_t>(parts.body.size())));
    }
    return parts;
}

}  // namespace diurna
