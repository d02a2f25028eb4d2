#include "terrain/objects/joined_ring.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace diurna {

namespace {

/// Whether a point lies on the straight line from a to b, ends excluded.
bool lies_between(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const double along = (p - a).dot(b - a), whole = (b - a).squaredNorm();
    return turn(a, b, p) == 0.0 && along > 0.0 && along < whole;
}

/// Whether a bridge meets a side elsewhere than at common corners.
bool meets(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c,
           const Eigen::Vector2d& d) {
    if (lies_between(c, a, b) || lies_between(d, a, b)) return true;
    if (a == c || a == d || b == c || b == d) return false;
    const double c_side = turn(a, b, c), d_side = turn(a, b, d);
    const double a_side = turn(c, d, a), b_side = turn(c, d, b);
    return c_side * d_side <= 0.0 && a_side * b_side <= 0.0 && (c_side != 0.0 || d_side != 0.0);
}

bool meets_ring(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        if (meets(a, b, ring[i], ring[(i + 1) % ring.size()])) return true;
    }
    return false;
}

/// Whether the way from corner i to a point begins inside the ring, which lies left of its sides.
bool begins_inside(const Ring& ring, std::size_t i, const Eigen::Vector2d& to) {
    const std::size_t n = ring.size();
    const Eigen::Vector2d &before = ring[(i + n - 1) % n], &at = ring[i],
                          &after = ring[(i + 1) % n];
    const bool left_in = turn(before, at, to) > 0.0, left_out = turn(at, after, to) > 0.0;
    return turn(before, at, after) >= 0.0 ? left_in && left_out : left_in || left_out;
}

/// The ring with a hole that touches it at a corner; none where it touches at none.
std::optional<Ring> with_touching_hole(const Ring& ring, const Ring& hole) {
    for (std::size_t k = 0; k < hole.size(); ++k) {
        const Eigen::Vector2d& after = hole[(k + 1) % hole.size()];
        for (std::size_t i = 0; i < ring.size(); ++i) {
            if (ring[i] != hole[k] || !begins_inside(ring, i, after)) continue;
            Ring joined(ring.begin(), ring.begin() + std::ptrdiff_t(i) + 1);
            for (std::size_t j = 1; j <= hole.size(); ++j) {
                joined.push_back(hole[(k + j) % hole.size()]);
            }
            joined.insert(joined.end(), ring.begin() + std::ptrdiff_t(i) + 1, ring.end());
            return joined;
        }
    }
    return std::nullopt;
}

/// The ring with one hole, by the shortest bridge from any corner of the ring to the hole's
/// easternmost corner that meets nothing; none where there is no such bridge.
std::optional<Ring> with_hole(const Ring& ring, const Ring& hole, std::span<const Ring> others) {
    const auto east = std::max_element(hole.begin(), hole.end(),
                                       [](const auto& a, const auto& b) { return a.x() < b.x(); });
    const auto start = std::size_t(east - hole.begin());
    std::vector<std::size_t> order(ring.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return (ring[a] - *east).squaredNorm() < (ring[b] - *east).squaredNorm();
    });
    for (const std::size_t i : order) {
        if (!begins_inside(ring, i, *east)) continue;
        const bool free = !meets_ring(ring[i], *east, ring) && !meets_ring(ring[i], *east, hole) &&
                          std::none_of(others.begin(), others.end(), [&](const Ring& other) {
                              return meets_ring(ring[i], *east, other);
                          });
        if (!free) continue;
        Ring joined(ring.begin(), ring.begin() + std::ptrdiff_t(i) + 1);
        for (std::size_t k = 0; k <= hole.size(); ++k) {
            joined.push_back(hole[(start + k) % hole.size()]);
        }
        joined.insert(joined.end(), ring.begin() + std::ptrdiff_t(i), ring.end());
        return joined;
    }
    return std::nullopt;
}

}  // namespace

std::optional<Ring> joined_ring(const Ring& ring, std::span<const Ring> holes) {
    const auto inside = [&](const Ring& hole) {
        return std::all_of(hole.begin(), hole.end(), [&](const Eigen::Vector2d& p) {
            return contains(ring, p) || std::find(ring.begin(), ring.end(), p) != ring.end();
        });
    };
    std::vector<Ring> left(holes.begin(), holes.end());
    if (!std::all_of(left.begin(), left.end(), inside)) return std::nullopt;
    // From the east, so that a hole is joined before one that it hides.
    std::stable_sort(left.begin(), left.end(), [](const Ring& a, const Ring& b) {
        const auto east = [](const Ring& hole) {
            double most = hole.front().x();
            for (const auto& p : hole) most = std::max(most, p.x());
            return most;
        };
        return east(a) < east(b);  // the last is taken first
    });
    Ring joined = ring;
    while (!left.empty()) {
        const Ring hole = std::move(left.back());
        left.pop_back();
        auto more = with_touching_hole(joined, hole);
        if (!more) more = with_hole(joined, hole, left);
        if (!more) return std::nullopt;
        joined = std::move(*more);
    }
    return joined;
}

}  // namespace diurna
