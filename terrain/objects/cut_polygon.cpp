#include "terrain/objects/cut_polygon.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

namespace diurna {

namespace {

using InPlane = Eigen::Vector2d;

double cross(const InPlane& a, const InPlane& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A polygon in its plane, counterclockwise, of which ears are clipped one by one.
class Ears {
 public:
    Ears(std::vector<InPlane> at, double extent) : at_(std::move(at)), flat_(1e-10 * extent) {
        const auto n = std::uint32_t(at_.size());
        for (std::uint32_t i = 0; i < n; ++i) {
            next_.push_back((i + 1) % n);
            before_.push_back((i + n - 1) % n);
            left_.push_back(i);
        }
        quality_.resize(n);
        for (std::uint32_t i = 0; i < n; ++i) quality_[i] = ear_quality(i);
    }

    /// Appends triangles of numbers of `at`; false if no ear was found at some time.
    bool cut(std::vector<std::array<std::uint32_t, 3>>& triangle) {
        bool found = true;
        while (left_.size() >= 3) {
            std::uint32_t ear = best();
            if (quality_[ear] <= 0.0) {
                for (const std::uint32_t i : left_) quality_[i] = ear_quality(i);
                ear = best();
            }
            if (quality_[ear] <= 0.0) {
                if (all_flat()) break;
                found = false;
                ear = any_convex();
            }
            if (turn(ear) > 0.0 || turn(ear) < -flat_ * reach(ear)) {
                triangle.push_back({before_[ear], ear, next_[ear]});
            }
            clip(ear);
        }
        return found;
    }

 private:
    /// Twice the area of the triangle at a corner.
    double turn(std::uint32_t i) const {
        return cross(at_[i] - at_[before_[i]], at_[next_[i]] - at_[i]);
    }
    double reach(std::uint32_t i) const {
        return std::max({(at_[i] - at_[before_[i]]).norm(), (at_[next_[i]] - at_[i]).norm(),
                         (at_[next_[i]] - at_[before_[i]]).norm()});
    }
    bool same(std::uint32_t a, std::uint32_t b) const { return (at_[a] - at_[b]).norm() <= flat_; }

    /// Height over longest edge, or 0 for what is no ear.
    double ear_quality(std::uint32_t i) const {
        const std::uint32_t a = before_[i], b = next_[i];
        const double longest = reach(i), area = turn(i);
        if (!(area > flat_ * longest)) return 0.0;
        const InPlane ab = at_[b] - at_[a];
        for (const std::uint32_t j : left_) {
            if (j == i || j == a || j == b) continue;
            if (same(j, i)) {
                // A bridge that goes on from here into the ear.
                for (const std::uint32_t q : {before_[j], next_[j]}) {
                    const InPlane way = at_[q] - at_[i];
                    if (cross(at_[b] - at_[i], way) > flat_ * way.norm() &&
                        cross(way, at_[a] - at_[i]) > flat_ * way.norm()) {
                        return 0.0;
                    }
                }
                continue;
            }
            if (same(j, a) || same(j, b)) continue;
            const InPlane& p = at_[j];
            const bool outside =
                cross(at_[i] - at_[a], p - at_[a]) < -flat_ * (at_[i] - at_[a]).norm() ||
                cross(at_[b] - at_[i], p - at_[i]) < -flat_ * (at_[b] - at_[i]).norm() ||
                cross(-ab, p - at_[b]) < -flat_ * ab.norm();
            if (!outside) return 0.0;
        }
        return area / (longest * longest);
    }
    std::uint32_t best() const {
        std::uint32_t best = left_[0];
        for (const std::uint32_t i : left_) {
            if (quality_[i] > 1.000001 * quality_[best]) best = i;
        }
        return best;
    }
    bool all_flat() const {
        return std::all_of(left_.begin(), left_.end(),
                           [&](std::uint32_t i) { return std::abs(turn(i)) <= flat_ * reach(i); });
    }
    std::uint32_t any_convex() const {
        return *std::max_element(left_.begin(), left_.end(),
                                 [&](auto a, auto b) { return turn(a) < turn(b); });
    }
    void clip(std::uint32_t ear) {
        const std::uint32_t a = before_[ear], b = next_[ear];
        next_[a] = b;
        before_[b] = a;
        left_.erase(std::lower_bound(left_.begin(), left_.end(), ear));
        quality_[a] = ear_quality(a);
        quality_[b] = ear_quality(b);
    }

    std::vector<InPlane> at_;
    double flat_;  // a length
    std::vector<std::uint32_t> next_, before_, left_;
    std::vector<double> quality_;
};

Eigen::Vector3d area_vector(std::span<const Eigen::Vector3d> corner) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (std::size_t i = 1; i + 1 < corner.size(); ++i) {
        sum += 0.5 * (corner[i] - corner[0]).cross(corner[i + 1] - corner[0]);
    }
    return sum;
}

/// Whether the triangles' areas along a direction add up to the polygon's, and none is against it.
bool covers(std::span<const Eigen::Vector3d> corner, const CutPolygon& cut,
            const Eigen::Vector3d& normal, double area) {
    constexpr double close = 1e-6;
    double sum = 0.0;
    for (const auto& [a, b, c] : cut.triangle) {
        const double part = 0.5 * (corner[b] - corner[a]).cross(corner[c] - corner[a]).dot(normal);
        if (part < -close * area) return false;
        sum += std::abs(part);
    }
    return std::abs(sum - area) <= close * area;
}

/// From the first corner, if the polygon is convex there.
std::optional<CutPolygon> quadrilateral(std::span<const Eigen::Vector3d> corner,
                                        const Eigen::Vector3d& normal, double area) {
    CutPolygon cut{{{0, 1, 2}, {0, 2, 3}}, true};
    for (const auto& [a, b, c] : cut.triangle) {
        const double part = 0.5 * (corner[b] - corner[a]).cross(corner[c] - corner[a]).dot(normal);
        if (part < 1e-6 * area) return {};
    }
    return cut;
}

}  // namespace

CutPolygon cut_polygon(std::span<const Eigen::Vector3d> corner) {
    std::vector<std::uint32_t> of;  // numbers without repeated places
    std::vector<Eigen::Vector3d> place;
    for (std::uint32_t i = 0; i < corner.size(); ++i) {
        if (!place.empty() && corner[i] == place.back()) continue;
        of.push_back(i);
        place.push_back(corner[i]);
    }
    while (place.size() > 1 && place.back() == place.front()) {
        place.pop_back();
        of.pop_back();
    }
    CutPolygon cut;
    if (place.size() < 3) return cut;
    const Eigen::Vector3d vector = area_vector(place);
    const double area = vector.norm();
    double extent = 0.0;
    for (const Eigen::Vector3d& at : place) extent = std::max(extent, (at - place[0]).norm());
    if (place.size() == 3) {
        cut.triangle = {{0, 1, 2}};
    } else if (!(area > 1e-12 * extent * extent)) {
        // Without an area, or as much one way as the other.
        for (std::uint32_t i = 1; i + 1 < place.size(); ++i) {
            cut.triangle.push_back({0, i, i + 1});
            const Eigen::Vector3d part = (place[i] - place[0]).cross(place[i + 1] - place[0]);
            if (part.norm() > 1e-9 * extent * extent) cut.sound = false;
        }
    } else {
        const Eigen::Vector3d normal = vector / area;
        const auto four = place.size() == 4 ? quadrilateral(place, normal, area) : std::nullopt;
        if (four) {
            cut = *four;
        } else {
            const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
            std::vector<InPlane> plan;
            for (const Eigen::Vector3d& at : place) {
                plan.emplace_back(u.dot(at - place[0]), v.dot(at - place[0]));
            }
            cut.sound = Ears(std::move(plan), extent).cut(cut.triangle);
            cut.sound = covers(place, cut, normal, area) && cut.sound;
        }
    }
    for (auto& triangle : cut.triangle) {
        for (std::uint32_t& i : triangle) i = of[i];
    }
    return cut;
}

}  // namespace diurna
