#include "terrain/objects/line_grid.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace diurna {

namespace {

double doubled_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector2d& p) {
    return (b.x() - a.x()) * (p.y() - a.y()) - (b.y() - a.y()) * (p.x() - a.x());
}

}  // namespace

LineGrid::LineGrid(std::span<const Eigen::Vector3d> vertex,
                   std::span<const std::array<std::uint32_t, 3>> triangle,
                   std::span<const std::uint32_t> which, const Eigen::Vector3d& direction)
    : turn_(Eigen::Quaterniond::FromTwoVectors(direction, Eigen::Vector3d::UnitZ())
                .toRotationMatrix()),
      origin_(which.empty() ? Eigen::Vector3d::Zero() : vertex[triangle[which[0]][0]]) {
    Eigen::AlignedBox2d box;
    for (const std::uint32_t t : which) {
        Flat flat{{}, t};
        for (std::size_t k = 0; k < 3; ++k) {
            flat.corner[k] = turn_ * (vertex[triangle[t][k]] - origin_);
            box.extend(flat.corner[k].head<2>());
        }
        flat_.push_back(flat);
    }
    constexpr double most = 512.0;
    side_ = std::size_t(std::clamp(std::sqrt(0.5 * double(which.size())), 1.0, most));
    low_ = box.isEmpty() ? Eigen::Vector2d::Zero() : Eigen::Vector2d(box.min());
    step_ = box.isEmpty() ? Eigen::Vector2d::Ones() : Eigen::Vector2d(box.sizes() / double(side_));

    // Counts first, then numbers.
    first_.assign(side_ * side_ + 1, 0);
    for (const bool counting : {true, false}) {
        std::vector<std::uint32_t> end(first_.begin(), first_.end() - 1);
        for (std::uint32_t f = 0; f < flat_.size(); ++f) {
            const auto& [a, b, c] = flat_[f].corner;
            std::array<std::size_t, 4> to{};
            for (int axis = 0; axis < 2; ++axis) {
                const auto [least, most_of] = std::minmax({a[axis], b[axis], c[axis]});
                to[std::size_t(2 * axis)] = cell(least, axis);
                to[std::size_t(2 * axis + 1)] = cell(most_of, axis);
            }
            for (std::size_t y = to[2]; y <= to[3]; ++y) {
                for (std::size_t x = to[0]; x <= to[1]; ++x) {
                    if (counting) {
                        ++first_[y * side_ + x + 1];
                    } else {
                        in_cell_[end[y * side_ + x]++] = f;
                    }
                }
            }
        }
        if (counting) {
            std::partial_sum(first_.begin(), first_.end(), first_.begin());
            in_cell_.resize(first_.back());
        }
    }
}

std::size_t LineGrid::cell(double across, int axis) const {
    const double at = step_[axis] > 0.0 ? (across - low_[axis]) / step_[axis] : 0.0;
    return std::size_t(std::clamp(at, 0.0, double(side_ - 1)));
}

LineGrid::Crossed LineGrid::crossed(const Eigen::Vector3d& point, std::uint32_t skipped) const {
    Crossed count;
    const Eigen::Vector3d at = turn_ * (point - origin_);
    const Eigen::Vector2d plan = at.head<2>();
    const std::size_t in = cell(plan.y(), 1) * side_ + cell(plan.x(), 0);
    for (std::uint32_t i = first_[in]; i < first_[in + 1]; ++i) {
        const auto& [corner, triangle] = flat_[in_cell_[i]];
        if (triangle == skipped) continue;
        const auto& [a, b, c] = corner;
        const double u = doubled_area(b, c, plan), v = doubled_area(c, a, plan),
                     w = doubled_area(a, b, plan), sum = u + v + w;
        if (sum == 0.0 || !((u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0))) {
            continue;
        }
        const double height = (u * a.z() + v * b.z() + w * c.z()) / sum;
        ++(height > at.z() ? count.ahead : count.behind);
    }
    return count;
}

}  // namespace diurna
