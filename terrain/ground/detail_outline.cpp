#include "terrain/ground/detail_outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace diurna {

namespace {

constexpr double beside = 0.05;  // [posts] of the detail

/// Marks what lies between two points and is to be kept.
void split(const Ring& ring, const std::vector<double>& height, std::size_t from, std::size_t to,
           double tolerance, std::vector<std::uint8_t>& kept) {
    std::vector<std::pair<std::size_t, std::size_t>> open{{from, to}};
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        const std::size_t n = ring.size();
        const Eigen::Vector2d &a = ring[first % n], way = ring[last % n] - a;
        const double rise = height[last % n] - height[first % n];
        double worst = std::max(tolerance, 1e-4);  // below lies the rounding of heights
        std::size_t furthest = first;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double t = (ring[i % n] - a).dot(way) / way.squaredNorm();
            const double error = std::abs(height[first % n] + t * rise - height[i % n]);
            if (error > worst) {
                worst = error;
                furthest = i;
            }
        }
        if (furthest == first) continue;
        kept[furthest % n] = 1;
        open.emplace_back(first, furthest);
        open.emplace_back(furthest, last);
    }
}

}  // namespace

Ring outline_vertices(const Dem& dem, const DemDetail& detail) {
    constexpr std::size_t most_apart = 64;
    const Ring& ring = detail.outline;
    const std::size_t n = ring.size();
    std::vector<double> height;
    for (const Eigen::Vector2d& p : ring) height.push_back(height_at(dem, p));
    std::vector<std::uint8_t> kept(n, 0);
    std::vector<std::size_t> fixed;
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector2d in = ring[i] - ring[(i + n - 1) % n],
                              out = ring[(i + 1) % n] - ring[i];
        const double sine = in.x() * out.y() - in.y() * out.x();
        const bool corner = std::abs(sine) > 0.01 * in.norm() * out.norm() || in.dot(out) < 0.0;
        if (!corner && i % most_apart != 0) continue;
        kept[i] = 1;
        fixed.push_back(i);
    }
    for (std::size_t k = 0; k < fixed.size(); ++k) {
        const std::size_t next = k + 1 < fixed.size() ? fixed[k + 1] : fixed.front() + n;
        split(ring, height, fixed[k], next, detail.tolerance, kept);
    }
    Ring vertices;
    for (std::size_t i = 0; i < n; ++i) {
        if (kept[i]) vertices.push_back(ring[i]);
    }
    return vertices;
}

bool beside_outline(const Dem& dem, const Eigen::Vector2d& place) {
    for (const DemDetail& detail : dem.detail) {
        const Eigen::Vector2d off =
            (place - place.cwiseMax(detail.to_own.low).cwiseMin(detail.to_own.high));
        if (off.cwiseAbs().maxCoeff() > beside) continue;  // of the coarse posts, which are wider
        const Eigen::Vector2d own = detail.to_own(place);
        const Eigen::Vector2d last(detail.raster.columns - 1.0, detail.raster.rows - 1.0);
        const double inside = std::min(own.minCoeff(), (last - own).minCoeff());
        if (std::abs(inside) < beside) return true;
        if (inside < 0.0) continue;
        // Along the coarse raster's edge, where the detail hangs over it.
        const Eigen::Vector2d far(dem.columns - 1.0, dem.rows - 1.0);
        const Eigen::Vector2d edge = place.cwiseMin(far - place);
        for (int axis = 0; axis < 2; ++axis) {
            const Eigen::Vector2d post = place + Eigen::Vector2d::Unit(axis);
            if (edge[axis] * (detail.to_own(post) - own).norm() < beside) return true;
        }
    }
    return false;
}

}  // namespace diurna
