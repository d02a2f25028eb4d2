#include "terrain/visibility/relief_cells.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "materials/base/random.hpp"
#include "terrain/ground/rings.hpp"

namespace diurna {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr double facets_per_cell = 4.0;
constexpr double most_cells_per_facet = 16.0;  // of the facets' boxes, on average
constexpr int most_cells_a_side = 4096;

/// Whether the facets round each vertex close up: each edge that leaves it for one facet comes back
/// to it for another. Sums of hashes tell sets of vertices apart.
std::vector<std::uint8_t> closed_vertices(const FacetSet& facets) {
    std::vector<std::uint64_t> open(facets.vertex.size(), 0);
    for (const auto& [a, b, c] : facets.corner) {
        const std::uint64_t x = hashed(a), y = hashed(b), z = hashed(c);
        open[a] += y - z;
        open[b] += z - x;
        open[c] += x - y;
    }
    std::vector<std::uint8_t> closed(open.size());
    std::transform(open.begin(), open.end(), closed.begin(),
                   [](std::uint64_t left) { return std::uint8_t{left == 0}; });
    return closed;
}

using CornersInPlan = std::array<Eigen::Vector2f, 3>;  // in plan, counterclockwise

bool covers(const CornersInPlan& triangle, const Eigen::Vector2f& p) {
    const auto& [a, b, c] = triangle;
    return turn(a, b, p) >= 0.0f && turn(b, c, p) >= 0.0f && turn(c, a, p) >= 0.0f;
}

}  // namespace

ReliefCells::ReliefCells(const FacetSet& facets, const Copies& copies) {
    if (facets.size() == 0) return;
    Eigen::Vector2f low = facets.vertex.front().head<2>(), high = low;
    for (const Eigen::Vector3f& v : facets.vertex) {
        low = low.cwiseMin(v.head<2>());
        high = high.cwiseMax(v.head<2>());
    }
    const Eigen::Vector2f size = high - low;
    const double area = std::max(1e-6, double{size.x()} * size.y());
    side = static_cast<float>(std::sqrt(area * facets_per_cell / double(facets.size())));
    side = std::max(side, size.maxCoeff() / most_cells_a_side);
    corner = low;
    Grid finest{.columns = static_cast<int>(size.x() / side) + 1,
                .rows = static_cast<int>(size.y() / side) + 1,
                .value = {}};
    finest.value.assign(std::size_t(finest.columns) * std::size_t(finest.rows), -infinite);
    steepest.assign(finest.value.size(), ByOctant{});
    top.push_back(std::move(finest));
    if (fill(facets)) {
        raise_by(facets, copies);
        stack_tops();
    } else {
        steepest.clear();
    }
}

CellBox ReliefCells::cells_of(const Eigen::Vector2f& low, const Eigen::Vector2f& high) const {
    const auto cell = [&](float x, float from, int count) {
        return std::clamp(static_cast<int>((x - from) / side), 0, count - 1);
    };
    const int columns = top.front().columns, rows = top.front().rows;
    return {cell(low.x(), corner.x(), columns), cell(high.x(), corner.x(), columns),
            cell(low.y(), corner.y(), rows), cell(high.y(), corner.y(), rows)};
}

/// False if the facets' boxes have too many cells for this to be worth it.
bool ReliefCells::fill(const FacetSet& facets) {
    const std::vector<std::uint8_t> closed = closed_vertices(facets);
    Grid& ground = top.front();
    std::vector<std::uint8_t> layers(ground.value.size(), 0);
    double left = most_cells_per_facet * double(facets.size() + ground.value.size());
    ByOctant no_relief;
    no_relief.fill(infinite);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const auto& [i, j, k] = facets.corner[f];
        const Eigen::Vector3f &a = facets.vertex[i], &b = facets.vertex[j], &c = facets.vertex[k];
        const Eigen::Vector3f low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
        const CellBox box = cells_of(low.head<2>(), high.head<2>());
        left -= double(box.last_column - box.first_column + 1) *
                double(box.last_row - box.first_row + 1);
        if (left < 0.0) return false;
        const Eigen::Vector3f& n = facets.normal[f];
        const bool relief = n.z() > 0.05f && closed[i] && closed[j] && closed[k];
        const ByOctant slope = relief ? steepest_rise(-n.x() / n.z(), -n.y() / n.z()) : no_relief;
        const CornersInPlan plan{a.head<2>(), b.head<2>(), c.head<2>()};
        for (int row = box.first_row; row <= box.last_row; ++row) {
            for (int column = box.first_column; column <= box.last_column; ++column) {
                const std::size_t cell = std::size_t(row) * ground.columns + std::size_t(column);
                ground.value[cell] = std::max(ground.value[cell], high.z());
                for (std::size_t o = 0; o < 8; ++o) {
                    steepest[cell][o] = std::max(steepest[cell][o], slope[o]);
                }
                const Eigen::Vector2f middle =
                    corner + side * Eigen::Vector2f(float(column) + 0.487f, float(row) + 0.523f);
                if (relief && covers(plan, middle)) {
                    layers[cell] = static_cast<std::uint8_t>(std::min(layers[cell] + 1, 2));
                }
            }
        }
    }
    for (std::size_t cell = 0; cell < layers.size(); ++cell) {
        if (layers[cell] != 1) steepest[cell] = no_relief;
    }
    return true;
}

void ReliefCells::raise_by(const FacetSet& facets, const Copies& copies) {
    Grid& ground = top.front();
    for (std::size_t c = 0; c < copies.size(); ++c) {
        const Eigen::AlignedBox3f box = copies.box(facets, c).cast<float>();
        const CellBox cells = cells_of(box.min().head<2>(), box.max().head<2>());
        for (int row = cells.first_row; row <= cells.last_row; ++row) {
            for (int column = cells.first_column; column <= cells.last_column; ++column) {
                const std::size_t cell = std::size_t(row) * ground.columns + std::size_t(column);
                ground.value[cell] = std::max(ground.value[cell], box.max().z());
                steepest[cell].fill(infinite);
            }
        }
    }
}

void ReliefCells::stack_tops() {
    while (top.back().columns > 1 || top.back().rows > 1) {
        const Grid& fine = top.back();
        Grid coarse{.columns = (fine.columns + 1) / 2, .rows = (fine.rows + 1) / 2, .value = {}};
        coarse.value.assign(std::size_t(coarse.columns) * std::size_t(coarse.rows), -infinite);
        for (int row = 0; row < fine.rows; ++row) {
            for (int column = 0; column < fine.columns; ++column) {
                float& highest = coarse.at(row / 2, column / 2);
                highest = std::max(highest, fine.at(row, column));
            }
        }
        top.push_back(std::move(coarse));
    }
}

}  // namespace diurna
