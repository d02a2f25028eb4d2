#include "terrain/visibility/sky_bound.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/random.hpp"

namespace diurna {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float nothing = -infinite;  // top of an empty cell
constexpr double facets_per_cell = 4.0;
constexpr double most_cells_per_facet = 16.0;  // of the facets' boxes, on average
constexpr int cells_near = 3;                  // round a patch, where slopes count and not heights
constexpr int most_cells_a_side = 4096;
// Ray origins are lifted off their facets and rounded.
constexpr float more = 1.001f, more_yet = 1e-3f;

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

constexpr float cos_half = 0.92387953f, sin_half = 0.38268343f;  // of 22.5°, half an octant

/// East and north of the middles of the octants.
struct Octants {
    std::array<float, 8> east{}, north{};
    constexpr Octants() {
        for (std::size_t k = 0; k < 8; ++k) {
            const bool flat = k & 4;
            east[k] = (k & 1 ? -1.0f : 1.0f) * (flat ? cos_half : sin_half);
            north[k] = (k & 2 ? -1.0f : 1.0f) * (flat ? sin_half : cos_half);
        }
    }
};
constexpr Octants octants;

/// How steeply a plane of this normal rises within each octant at most; infinite if it is no
/// relief.
SkyBound::Sines slopes(const Eigen::Vector3f& normal, bool relief) {
    SkyBound::Sines slope;
    slope.fill(infinite);
    if (!relief) return slope;
    const float east = -normal.x() / normal.z(), north = -normal.y() / normal.z();
    constexpr float diagonal = 0.70710678f;
    for (std::size_t k = 0; k < 8; ++k) {  // along the octant's two borders
        const float x = k & 1 ? -east : east, y = k & 2 ? -north : north;
        slope[k] = std::max({k & 4 ? x : y, diagonal * (x + y), 0.0f});
    }
    slope[SkyBound::octant(east, north)] = std::hypot(east, north);
    return slope;
}

bool covers(const Eigen::Vector2f& a, const Eigen::Vector2f& b, const Eigen::Vector2f& c,
            const Eigen::Vector2f& p) {
    const auto left_of = [&](const Eigen::Vector2f& u, const Eigen::Vector2f& v) {
        return (v.x() - u.x()) * (p.y() - u.y()) - (v.y() - u.y()) * (p.x() - u.x()) >= 0.0f;
    };
    return left_of(a, b) && left_of(b, c) && left_of(c, a);
}

}  // namespace

SkyBound::SkyBound(const FacetSet& facets) {
    if (facets.size() == 0) return;
    Eigen::Vector2f low = facets.vertex.front().head<2>(), high = low;
    for (const Eigen::Vector3f& v : facets.vertex) {
        low = low.cwiseMin(v.head<2>());
        high = high.cwiseMax(v.head<2>());
    }
    const Eigen::Vector2f size = high - low;
    const double area = std::max(1e-6, double{size.x()} * size.y());
    cell_ = static_cast<float>(std::sqrt(area * facets_per_cell / double(facets.size())));
    cell_ = std::max(cell_, size.maxCoeff() / most_cells_a_side);
    corner_ = low;
    level_.push_back({.columns = static_cast<int>(size.x() / cell_) + 1,
                      .rows = static_cast<int>(size.y() / cell_) + 1,
                      .top = {}});
    const std::size_t cells = std::size_t(level_[0].columns) * std::size_t(level_[0].rows);
    level_[0].top.assign(cells, nothing);
    steepest_.assign(cells, Sines{});
    fill_cells(facets, closed_vertices(facets));
    if (!steepest_.empty()) stack_levels();
}

SkyBound::CellBox SkyBound::cells_of(const Eigen::Vector2f& low,
                                     const Eigen::Vector2f& high) const {
    const auto cell = [&](float x, float from, int count) {
        return std::clamp(static_cast<int>((x - from) / cell_), 0, count - 1);
    };
    return {cell(low.x(), corner_.x(), level_[0].columns),
            cell(high.x(), corner_.x(), level_[0].columns),
            cell(low.y(), corner_.y(), level_[0].rows),
            cell(high.y(), corner_.y(), level_[0].rows)};
}

void SkyBound::fill_cells(const FacetSet& facets, const std::vector<std::uint8_t>& closed) {
    Level& ground = level_[0];
    std::vector<std::uint8_t> layers(ground.top.size(), 0);
    double left = most_cells_per_facet * double(facets.size() + ground.top.size());
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const auto& [i, j, k] = facets.corner[f];
        const Eigen::Vector3f &a = facets.vertex[i], &b = facets.vertex[j], &c = facets.vertex[k];
        const Eigen::Vector3f low = a.cwiseMin(b).cwiseMin(c), high = a.cwiseMax(b).cwiseMax(c);
        const CellBox box = cells_of(low.head<2>(), high.head<2>());
        left -= double(box.last_column - box.first_column + 1) *
                double(box.last_row - box.first_row + 1);
        if (left < 0.0) {  // long slivers all over the place: not worth it
            steepest_.clear();
            return;
        }
        const Eigen::Vector3f& n = facets.normal[f];
        const bool relief = n.z() > 0.05f && closed[i] && closed[j] && closed[k];
        const Sines slope = slopes(n, relief);
        for (int row = box.first_row; row <= box.last_row; ++row) {
            for (int column = box.first_column; column <= box.last_column; ++column) {
                const std::size_t cell = std::size_t(row) * ground.columns + std::size_t(column);
                ground.top[cell] = std::max(ground.top[cell], high.z());
                for (std::size_t o = 0; o < 8; ++o) {
                    steepest_[cell][o] = std::max(steepest_[cell][o], slope[o]);
                }
                const Eigen::Vector2f middle =
                    corner_ + cell_ * Eigen::Vector2f(float(column) + 0.487f, float(row) + 0.523f);
                if (relief && covers(a.head<2>(), b.head<2>(), c.head<2>(), middle)) {
                    layers[cell] = static_cast<std::uint8_t>(std::min(layers[cell] + 1, 2));
                }
            }
        }
    }
    for (std::size_t cell = 0; cell < layers.size(); ++cell) {
        if (layers[cell] != 1) steepest_[cell].fill(infinite);
    }
}

void SkyBound::stack_levels() {
    while (level_.back().columns > 1 || level_.back().rows > 1) {
        const Level& fine = level_.back();
        Level coarse{.columns = (fine.columns + 1) / 2, .rows = (fine.rows + 1) / 2, .top = {}};
        coarse.top.assign(std::size_t(coarse.columns) * std::size_t(coarse.rows), nothing);
        for (int row = 0; row < fine.rows; ++row) {
            for (int column = 0; column < fine.columns; ++column) {
                float& top = coarse.at(row / 2, column / 2);
                top = std::max(top, fine.at(row, column));
            }
        }
        level_.push_back(std::move(coarse));
    }
}

SkyBound::Sines SkyBound::sines(const FacetSet& facets, std::size_t begin, std::size_t end) const {
    if (steepest_.empty() || begin == end) return unknown;
    Eigen::Vector3f low = facets.centroid[begin], high = low;
    for (std::size_t f = begin; f < end; ++f) {
        for (const std::uint32_t v : facets.corner[f]) {
            low = low.cwiseMin(facets.vertex[v]);
            high = high.cwiseMax(facets.vertex[v]);
        }
    }
    CellBox near = cells_of(low.head<2>(), high.head<2>());
    near = {std::max(near.first_column - cells_near, 0),
            std::min(near.last_column + cells_near, level_[0].columns - 1),
            std::max(near.first_row - cells_near, 0),
            std::min(near.last_row + cells_near, level_[0].rows - 1)};
    Sines squared{};  // of tangents
    for (int row = near.first_row; row <= near.last_row; ++row) {
        for (int column = near.first_column; column <= near.last_column; ++column) {
            const Sines& here = steepest_[std::size_t(row) * level_[0].columns + column];
            for (std::size_t o = 0; o < 8; ++o) squared[o] = std::max(squared[o], here[o]);
        }
    }
    if (std::isinf(squared[0])) return unknown;
    for (float& s : squared) s *= s;

    // Rings of cells outward, each ring of cells twice as wide as those of the one before.
    const Eigen::Vector2f middle = 0.5f * (low + high).head<2>();
    const float block_radius = 0.5f * (high - low).head<2>().norm();
    const float highest = level_.back().top.front() - low.z();
    float cell = cell_, least = 0.0f;
    for (std::size_t k = 0; k < level_.size(); ++k, cell *= 2.0f) {
        const Level& level = level_[k];
        const float reach = block_radius + 0.70710678f * cell;
        const CellBox next{std::max((near.first_column >> 1) - 1, 0), (near.last_column >> 1) + 1,
                           std::max((near.first_row >> 1) - 1, 0), (near.last_row >> 1) + 1};
        const int last_row = std::min(2 * next.last_row + 1, level.rows - 1);
        const int last_column = std::min(2 * next.last_column + 1, level.columns - 1);
        for (int row = 2 * next.first_row; row <= last_row; ++row) {
            least = *std::min_element(squared.begin(), squared.end());
            const float south = corner_.y() + cell * float(row);
            const float dy = std::max({south - high.y(), low.y() - south - cell, 0.0f});
            const bool beside = row >= near.first_row && row <= near.last_row;
            for (int column = 2 * next.first_column; column <= last_column; ++column) {
                if (beside && column == near.first_column) column = near.last_column + 1;
                if (column > last_column) break;
                const float rise = level.at(row, column) - low.z();
                const float west = corner_.x() + cell * float(column);
                const float dx = std::max({west - high.x(), low.x() - west - cell, 0.0f});
                const float away = dx * dx + dy * dy;
                if (!(rise > 0.0f && rise * rise > least * away)) continue;
                // The octants that a circle round the cell reaches into, seen from anywhere in one
                // round the patch.
                const Eigen::Vector2f way = Eigen::Vector2f(west, south).array() + 0.5f * cell;
                const Eigen::Vector2f to = way - middle;
                const float free = to.squaredNorm() - reach * reach;
                const float limit =
                    free > 0.0f ? cos_half * std::sqrt(free) - sin_half * reach : -infinite;
                const float steep = rise * rise / away;
                for (std::size_t o = 0; o < 8; ++o) {
                    const float along = to.x() * octants.east[o] + to.y() * octants.north[o];
                    squared[o] = along >= limit ? std::max(squared[o], steep) : squared[o];
                }
            }
        }
        // Whatever lies outside the next ring is farther than one of its cells.
        least = *std::min_element(squared.begin(), squared.end());
        const float beyond = 2.0f * cell;
        if (!(highest > 0.0f) || highest * highest <= least * beyond * beyond) break;
        near = {next.first_column, std::min(next.last_column, (level.columns - 1) / 2),
                next.first_row, std::min(next.last_row, (level.rows - 1) / 2)};
    }
    Sines result;
    for (std::size_t o = 0; o < 8; ++o) {
        const float tangent = std::sqrt(squared[o]) * more + more_yet;
        result[o] = tangent / std::sqrt(1.0f + tangent * tangent);
    }
    return result;
}

}  // namespace diurna
