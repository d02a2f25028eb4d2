#include "terrain/visibility/relief_points.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "materials/base/random.hpp"

namespace diurna {

namespace {

constexpr double points_per_cell = 6.0;
constexpr int most_points = 64;
constexpr float coarse_cells = 2.0f;

}  // namespace

ReliefPoints::ReliefPoints(const FacetSet& facets, const HeightField& relief,
                           std::size_t ground_facets)
    : relief_(relief), coarse_(ground_facets, 0), off_relief_(ground_facets, 0) {
    first_.reserve(ground_facets + 1);
    std::vector<Eigen::Vector2d> place(facets.vertex.size());
    for_each_index(place.size(), [&](std::size_t v) {
        place[v] = relief.post(facets.vertex[v].head<2>().cast<double>());
    });
    for (std::size_t f = 0; f < ground_facets; ++f) {
        const auto& [a, b, c] = facets.corner[f];
        add(f, {place[a], place[b], place[c]});
    }
    first_.push_back(static_cast<std::uint32_t>(point_.size()));
}

/// `corner`: in (column, row).
void ReliefPoints::add(std::size_t facet, const std::array<Eigen::Vector2d, 3>& corner) {
    first_.push_back(static_cast<std::uint32_t>(point_.size()));
    const Eigen::Vector2d b = corner[1] - corner[0], c = corner[2] - corner[0];
    const double cells = 0.5 * std::abs(b.x() * c.y() - b.y() * c.x());
    coarse_[facet] = cells > coarse_cells;
    const int points =
        static_cast<int>(std::clamp(std::round(points_per_cell * cells), 1.0, double(most_points)));
    for (int k = 0; k < points; ++k) {
        // Roberts' sequence, evenly over the triangle; a single point in its middle.
        double u = 4.0 / 9.0, v = 0.5;
        if (points > 1) {
            u = std::fmod(0.5 + even_step_x * k, 1.0);
            v = std::fmod(0.5 + even_step_y * k, 1.0);
        }
        const double root = std::sqrt(u);
        const Eigen::Vector2d p = corner[0] + (1.0 - root) * b + root * v * c;
        const double x = std::clamp(p.x(), 0.0, relief_.columns() - 1.0);
        const double y = std::clamp(p.y(), 0.0, relief_.rows() - 1.0);
        const int column = std::min(static_cast<int>(x), relief_.columns() - 2);
        const int row = std::min(static_cast<int>(y), relief_.rows() - 2);
        point_.push_back({static_cast<std::uint32_t>(row * relief_.columns() + column),
                          static_cast<float>(x - column), static_cast<float>(y - row)});
        if ((p - Eigen::Vector2d(x, y)).norm() > 0.5) off_relief_[facet] = 1;
        for (int i = 0; i < 4; ++i) {
            if (relief_.up(row + i / 2, column + i % 2) == no_ground) off_relief_[facet] = 1;
        }
    }
}

Eigen::Vector3f ReliefPoints::grid_normal(const ReliefPoint& p) const {
    const int row = static_cast<int>(p.post) / relief_.columns();
    const int column = static_cast<int>(p.post) % relief_.columns();
    const float a = relief_.up(row, column), d = relief_.up(row + 1, column + 1);
    const float b = relief_.up(row, column + 1), c = relief_.up(row + 1, column);
    const Eigen::Vector2d slope =
        p.u >= p.v ? Eigen::Vector2d(b - a, d - b) : Eigen::Vector2d(d - c, c - a);
    const Eigen::Vector2d gradient =
        relief_.jacobian({column + 0.5, row + 0.5}).transpose().inverse() * slope;
    return Eigen::Vector3d(-gradient.x(), -gradient.y(), 1.0).normalized().cast<float>();
}

}  // namespace diurna
