#include "scenes/job/world/overlaps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace diurna {

namespace {

Eigen::Vector2d side_of(const BodyBox& box) { return {-box.along.y(), box.along.x()}; }

/// Half of what a box covers along an axis.
double half_along(const BodyBox& box, const Eigen::Vector2d& axis) {
    return box.half_length * std::abs(axis.dot(box.along)) +
           box.half_width * std::abs(axis.dot(side_of(box)));
}

/// How far one would have to be moved to be clear of the other; not positive: they are.
double depth(const BodyBox& a, const BodyBox& b) {
    double least = std::min(a.top, b.top) - std::max(a.bottom, b.bottom);
    for (const Eigen::Vector2d& axis : {a.along, side_of(a), b.along, side_of(b)}) {
        const double apart = std::abs(axis.dot(b.middle - a.middle));
        least = std::min(least, half_along(a, axis) + half_along(b, axis) - apart);
    }
    return least;
}

}  // namespace

Overlaps overlaps(std::span<const BodyBox> boxes, double least) {
    // By their western ends: one that begins east of another's end is clear of it.
    const auto end = [&](std::size_t k, double sign) {
        return boxes[k].middle.x() + sign * half_along(boxes[k], Eigen::Vector2d::UnitX());
    };
    std::vector<std::size_t> order(boxes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return end(a, -1.0) < end(b, -1.0); });
    Overlaps found;
    for (std::size_t i = 0; i < order.size(); ++i) {
        for (std::size_t j = i + 1; j < order.size() && end(order[j], -1.0) < end(order[i], 1.0);
             ++j) {
            const double deep = depth(boxes[order[i]], boxes[order[j]]);
            if (deep <= least) continue;
            ++found.pairs;
            if (deep <= found.deepest) continue;
            found.deepest = deep;
            found.worst = std::minmax(order[i], order[j]);
        }
    }
    return found;
}

}  // namespace diurna
