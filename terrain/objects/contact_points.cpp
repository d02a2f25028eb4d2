#include "terrain/objects/contact_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace diurna {

namespace {

Eigen::Vector2d one_of_eight(int k) {
    const double angle = 0.25 * std::numbers::pi * k;
    return {std::cos(angle), std::sin(angle)};
}

}  // namespace

std::vector<Eigen::Vector3d> contact_points(const MeshFile& mesh, const Placing& placing) {
    return contact_points(mesh, placing, Eigen::Matrix3d::Identity());
}

std::vector<Eigen::Vector3d> contact_points(const MeshFile& mesh, const Placing& placing,
                                            const Eigen::Matrix3d& turn) {
    constexpr double share = 0.02, least = 1e-3;  // of the height; [m]
    if (mesh.vertex.empty()) return {};
    const MeshFrame frame(mesh, placing);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& v : mesh.vertex) box.extend(turn * frame.place(v));
    const double limit = box.min().z() + std::max(least, share * box.sizes().z());
    std::vector<Eigen::Vector3d> low, turned;
    for (const Eigen::Vector3d& v : mesh.vertex) {
        const Eigen::Vector3d at = frame.place(v), there = turn * at;
        if (there.z() > limit) continue;
        low.push_back(at);
        turned.push_back(there);
    }
    std::vector<Eigen::Vector3d> outermost;
    for (int k = 0; k < 8; ++k) {
        // Of several as far out the one that is further along the next side: corners of a box.
        const Eigen::Vector2d out = one_of_eight(k), aside = one_of_eight(k + 2);
        const auto reach = [&](const Eigen::Vector3d& at) {
            return at.head<2>().dot(out) + 1e-6 * at.head<2>().dot(aside);
        };
        const auto found =
            std::max_element(turned.begin(), turned.end(),
                             [&](const auto& a, const auto& b) { return reach(a) < reach(b); });
        const Eigen::Vector3d& at = low[std::size_t(found - turned.begin())];
        const bool known = std::any_of(outermost.begin(), outermost.end(),
                                       [&](const auto& other) { return other == at; });
        if (!known) outermost.push_back(at);
    }
    return outermost;
}

double least_width(const std::vector<Eigen::Vector3d>& points) {
    if (points.empty()) return 0.0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 4; ++k) {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Eigen::Vector3d& at : points) {
            const double along = at.head<2>().dot(one_of_eight(k));
            low = std::min(low, along);
            high = std::max(high, along);
        }
        least = std::min(least, high - low);
    }
    return least;
}

}  // namespace diurna
