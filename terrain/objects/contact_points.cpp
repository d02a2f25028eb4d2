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
    constexpr double share = 0.02, least = 1e-3;  // of the height; [m]
    if (mesh.vertex.empty()) return {};
    const MeshFrame frame(mesh, placing);
    double height = 0.0;
    for (const Eigen::Vector3d& v : mesh.vertex) height = std::max(height, frame.place(v).z());
    std::vector<Eigen::Vector3d> low;
    for (const Eigen::Vector3d& v : mesh.vertex) {
        const Eigen::Vector3d at = frame.place(v);
        if (at.z() <= std::max(least, share * height)) low.push_back(at);
    }
    std::vector<Eigen::Vector3d> outermost;
    for (int k = 0; k < 8; ++k) {
        // Of several as far out the one that is further along the next side: corners of a box.
        const Eigen::Vector2d out = one_of_eight(k), aside = one_of_eight(k + 2);
        const auto reach = [&](const Eigen::Vector3d& at) {
            return at.head<2>().dot(out) + 1e-6 * at.head<2>().dot(aside);
        };
        const auto found =
            std::max_element(low.begin(), low.end(),
                             [&](const auto& a, const auto& b) { return reach(a) < reach(b); });
        const bool known = std::any_of(outermost.begin(), outermost.end(),
                                       [&](const auto& other) { return other == *found; });
        if (!known) outermost.push_back(*found);
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
