#include "terrain/objects/walls.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace diurna {

namespace {

using Line = std::vector<Eigen::Vector3d>;

constexpr double plan_tolerance = 1.0;  // [m], beyond the rings' snapping to posts
constexpr double least_height = 0.01;   // [m] of a wall that is built

double distance_to_side(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b) {
    const Eigen::Vector2d side = b - a;
    const double share = std::clamp((p - a).dot(side) / side.squaredNorm(), 0.0, 1.0);
    return (a + share * side - p).norm();
}

/// The foot of each side of the plan; none if the border does not pass the corners in order or
/// leaves a side.
std::optional<std::vector<Line>> foot_of_sides(const Ring& ring, const Line& border) {
    if (border.size() < ring.size()) return {};
    std::vector<std::size_t> at;
    for (const Eigen::Vector2d& corner : ring) {
        const auto nearest = std::min_element(
            border.begin(), border.end(), [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
                return (a.head<2>() - corner).squaredNorm() < (b.head<2>() - corner).squaredNorm();
            });
        if ((nearest->head<2>() - corner).norm() > plan_tolerance) return {};
        at.push_back(std::size_t(nearest - border.begin()));
    }
    std::vector<Line> sides;
    std::size_t walked = 0;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const std::size_t n = border.size();
        const std::size_t steps = (at[(i + 1) % at.size()] + n - at[i]) % n;
        walked += steps;
        Line side;
        for (std::size_t k = 0; k <= steps; ++k) {
            const Eigen::Vector3d& p = border[(at[i] + k) % n];
            const Eigen::Vector2d &a = ring[i], &b = ring[(i + 1) % at.size()];
            if (distance_to_side(p.head<2>(), a, b) > plan_tolerance) return {};
            side.push_back(p);
        }
        sides.push_back(std::move(side));
    }
    if (walked != border.size()) return {};
    return sides;
}

/// Where rows end, as shares of the way from the foot to the top: 0, ..., 1.
std::vector<double> rows_of(double height, double lowest_row, double side) {
    std::vector<double> end{0.0};
    double row = lowest_row;
    for (; row < side && end.back() + 2.0 * row < height; row *= 2.0) {
        end.push_back(end.back() + row);
    }
    const double left = height - end.back();
    const int parts = std::max(1, static_cast<int>(std::ceil(left / side - 1e-9)));
    const double from = end.back();
    for (int k = 1; k <= parts; ++k) end.push_back(from + left * k / parts);
    for (double& e : end) e /= end.back();
    end.back() = 1.0;
    return end;
}

/// One side of the walls.
class WallSide {
 public:
    WallSide(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const Line& foot,
             const WallsSpec& spec)
        : from_(from), to_(to), foot_(foot), spec_(spec) {
        const double length = (to - from).norm();
        parts_ = std::max(1, static_cast<int>(std::ceil(length / spec.side - 1e-9)));
        for (const Eigen::Vector3d& p : foot) {
            const double t = (p.head<2>() - from).dot(to - from) / (length * length);
            along_.push_back(std::clamp(t, 0.0, 1.0));
        }
        along_.front() = 0.0;
        along_.back() = 1.0;
        for (std::size_t i = 1; i < along_.size(); ++i) {
            along_[i] = std::max(along_[i], along_[i - 1]);
        }
    }

    void build(const std::vector<double>& rows, MaterialId material, ObjectMesh& mesh) const {
        const std::uint32_t lowest = lattice_row(rows[1], mesh);
        const auto first = static_cast<std::uint32_t>(mesh.vertex.size());
        for (const Eigen::Vector3d& p : foot_) mesh.vertex.push_back(at_most(p));
        sew(first, lowest, material, mesh);
        std::uint32_t below = lowest;
        for (std::size_t r = 2; r < rows.size(); ++r) {
            const std::uint32_t above = lattice_row(rows[r], mesh);
            for (std::uint32_t u = 0; u < static_cast<std::uint32_t>(parts_); ++u) {
                add(below + u, below + u + 1, above + u + 1, material, mesh);
                add(below + u, above + u + 1, above + u, material, mesh);
            }
            below = above;
        }
    }

 private:
    /// A point of the foot, no higher than the wall.
    Eigen::Vector3f at_most(const Eigen::Vector3d& p) const {
        return Eigen::Vector3d(p.x(), p.y(), std::min(p.z(), spec_.top)).cast<float>();
    }

    /// The ground's height at a share of the side.
    double ground_at(double t) const {
        if (t <= 0.0) return foot_.front().z();
        const auto next = std::upper_bound(along_.begin(), along_.end(), t);
        if (next == along_.end()) return foot_.back().z();
        const auto i = static_cast<std::size_t>(next - along_.begin());
        const double gap = along_[i] - along_[i - 1];
        const double share = gap > 0.0 ? (t - along_[i - 1]) / gap : 1.0;
        return std::lerp(foot_[i - 1].z(), foot_[i].z(), share);
    }

    std::uint32_t lattice_row(double share, ObjectMesh& mesh) const {
        const auto first = static_cast<std::uint32_t>(mesh.vertex.size());
        for (int u = 0; u <= parts_; ++u) {
            const double t = double(u) / parts_;
            const Eigen::Vector2d place =
                u == parts_ ? to_ : Eigen::Vector2d(from_ + t * (to_ - from_));
            const double ground = std::min(ground_at(t), spec_.top);
            const double up = share == 1.0 ? spec_.top : ground + share * (spec_.top - ground);
            mesh.vertex.push_back(Eigen::Vector3d(place.x(), place.y(), up).cast<float>());
        }
        return first;
    }

    /// Triangles between the foot and the row above it, whose vertices differ.
    void sew(std::uint32_t foot, std::uint32_t row, MaterialId material, ObjectMesh& mesh) const {
        std::uint32_t i = 0, j = 0;
        const auto last = static_cast<std::uint32_t>(along_.size() - 1);
        const auto end = static_cast<std::uint32_t>(parts_);
        while (i < last || j < end) {
            const bool along_foot =
                j == end || (i < last && along_[i + 1] <= (j + 1.0) / double(parts_) + 1e-9);
            if (along_foot) {
                add(foot + i, foot + i + 1, row + j, material, mesh);
                ++i;
            } else {
                add(foot + i, row + j + 1, row + j, material, mesh);
                ++j;
            }
        }
    }

    /// Adds a triangle, unless the ground has swallowed it.
    void add(std::uint32_t a, std::uint32_t b, std::uint32_t c, MaterialId material,
             ObjectMesh& mesh) const {
        const Eigen::Vector3f across =
            (mesh.vertex[b] - mesh.vertex[a]).cross(mesh.vertex[c] - mesh.vertex[a]);
        const float base = std::max({(mesh.vertex[b] - mesh.vertex[a]).norm(),
                                     (mesh.vertex[c] - mesh.vertex[a]).norm(),
                                     (mesh.vertex[c] - mesh.vertex[b]).norm()});
        if (!(across.norm() > base * float(least_height))) return;
        mesh.triangle.push_back({a, b, c});
        mesh.material.push_back(material);
    }

    Eigen::Vector2d from_, to_;
    const Line& foot_;
    const WallsSpec& spec_;
    int parts_ = 1;
    std::vector<double> along_;  // (point of the foot) share of the side, ascending from 0 to 1
};

}  // namespace

bool goes_round(const std::vector<Eigen::Vector3d>& border, const Ring& ring) {
    return foot_of_sides(ring, border).has_value();
}

bool append_walls(const WallsSpec& spec, ObjectMesh& mesh) {
    const std::size_t corners = spec.ring.size();
    std::optional<std::vector<Line>> foot = foot_of_sides(spec.ring, spec.foot);
    const bool known = foot.has_value();
    if (!known) {
        foot.emplace();
        for (std::size_t i = 0; i < corners; ++i) {
            const Eigen::Vector2d &a = spec.ring[i], &b = spec.ring[(i + 1) % corners];
            const double length = (b - a).norm();
            const int parts = std::max(1, static_cast<int>(std::ceil(length / spec.side - 1e-9)));
            Line line;
            for (int u = 0; u <= parts; ++u) {
                const Eigen::Vector2d p =
                    u == parts ? b : Eigen::Vector2d(a + double(u) / parts * (b - a));
                line.emplace_back(p.x(), p.y(), spec.bottom);
            }
            foot->push_back(std::move(line));
        }
    }
    double lowest = spec.top;
    for (const Line& side : *foot) {
        for (const Eigen::Vector3d& p : side) lowest = std::min(lowest, p.z());
    }
    const std::vector<double> rows =
        rows_of(std::max(spec.top - lowest, least_height),
                known ? std::min(spec.lowest_row, spec.side) : spec.side, spec.side);
    for (std::size_t i = 0; i < corners; ++i) {
        WallSide(spec.ring[i], spec.ring[(i + 1) % corners], (*foot)[i], spec)
            .build(rows, spec.material[i], mesh);
    }
    return known;
}

ObjectMesh welded(const ObjectMesh& mesh) {
    ObjectMesh result{.vertex = {}, .triangle = {}, .material = mesh.material};
    std::map<std::array<float, 3>, std::uint32_t> number;
    std::vector<std::uint32_t> of;
    for (const Eigen::Vector3f& v : mesh.vertex) {
        const auto [found, fresh] = number.try_emplace(
            {v.x(), v.y(), v.z()}, static_cast<std::uint32_t>(result.vertex.size()));
        if (fresh) result.vertex.push_back(v);
        of.push_back(found->second);
    }
    for (const auto& [a, b, c] : mesh.triangle) result.triangle.push_back({of[a], of[b], of[c]});
    return result;
}

}  // namespace diurna
