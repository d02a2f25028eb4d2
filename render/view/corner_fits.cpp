#include "render/view/corner_fits.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

constexpr double steepest = 0.342;    // cosine of 70°
constexpr float one_ground = 0.5f;    // cosine of 60°
constexpr float one_face = 0.94f;     // cosine of 20°
constexpr double least_spread = 0.1;  // of neighbours across their line: 1 all around

/// Facets at some vertices, in compressed rows.
class FacetsAtVertex {
 public:
    FacetsAtVertex(const FacetSet& facets, std::span<const SurfaceId> chosen)
        : place_(facets.vertex.size(), none) {
        std::uint32_t count = 0;
        for (const SurfaceId f : chosen) {
            for (const std::uint32_t v : facets.corner[index(f)]) {
                if (place_[v] == none) place_[v] = count++;
            }
        }
        row_.assign(count + 1, 0);
        const auto each = [&](const auto& body) {
            for (std::size_t f = 0; f < facets.size(); ++f) {
                for (const std::uint32_t v : facets.corner[f]) {
                    if (place_[v] != none) body(place_[v], static_cast<std::uint32_t>(f));
                }
            }
        };
        each([&](std::uint32_t at, std::uint32_t) { ++row_[at + 1]; });
        for (std::size_t k = 1; k < row_.size(); ++k) row_[k] += row_[k - 1];
        facet_.resize(row_.back());
        std::vector<std::uint32_t> next(row_.begin(), row_.end() - 1);
        each([&](std::uint32_t at, std::uint32_t f) { facet_[next[at]++] = f; });
    }
    std::size_t size() const { return row_.size() - 1; }
    std::size_t place(std::uint32_t vertex) const { return place_[vertex]; }
    std::span<const std::uint32_t> of(std::size_t place) const {
        return std::span(facet_).subspan(row_[place], row_[place + 1] - row_[place]);
    }
    std::span<const std::uint32_t> operator[](std::uint32_t vertex) const {
        return of(place_[vertex]);
    }

 private:
    static constexpr auto none = ~std::uint32_t{0};
    std::vector<std::uint32_t> place_, row_{}, facet_{};
};

/// Whether two facets belong to one smooth surface.
bool smoothly_joined(const FacetSet& facets, std::size_t a, std::size_t b) {
    return facets.material[a] == facets.material[b] && facets.object[a] == facets.object[b] &&
           facets.normal[a].dot(facets.normal[b]) >=
               (facets.object[a] == ObjectId{0} ? one_ground : one_face);
}

/// Facets and all with a common corner, ascending, each once.
std::vector<SurfaceId> with_neighbours(std::span<const SurfaceId> chosen, const FacetSet& facets) {
    const FacetsAtVertex at_vertex(facets, chosen);
    std::vector<SurfaceId> all(chosen.begin(), chosen.end());
    for (std::size_t v = 0; v < at_vertex.size(); ++v) {
        for (const std::uint32_t other : at_vertex.of(v)) all.push_back(SurfaceId{other});
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace

Eigen::Matrix<double, 2, 3> surface_axes(const Eigen::Vector3d& n, ObjectId object) {
    if (object == ObjectId{0} && n.z() > steepest) return Eigen::Matrix<double, 2, 3>::Identity();
    const double sign = std::copysign(1.0, n.z());
    const double a = -1.0 / (sign + n.z()), b = n.x() * n.y() * a;
    Eigen::Matrix<double, 2, 3> axes;
    axes << 1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x(),  //
        b, sign + n.y() * n.y() * a, -n.y();
    return axes;
}

CornerPlane corner_plane(const FacetSet& facets, std::uint32_t corner, ObjectId object,
                         std::span<const std::uint32_t> others) {
    CornerPlane plane;
    // In the plane across their mean normal, the same for all that are joined.
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    for (const std::uint32_t other : others) normal += facets.normal[other].cast<double>();
    if (!(normal.squaredNorm() > 0.0)) return plane;
    plane.axes = surface_axes(normal.normalized(), object);
    Eigen::Vector2d first = Eigen::Vector2d::Zero();
    Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
    for (const std::uint32_t other : others) {
        const Eigen::Vector3d away =
            facets.centroid[other].cast<double>() - facets.vertex[corner].cast<double>();
        if (!(away.squaredNorm() > 0.0)) continue;
        const double weight = 1.0 / away.squaredNorm();
        const Eigen::Vector2d off = plane.axes * away;
        plane.weights += weight;
        first += weight * off;
        second += weight * off * off.transpose();
    }
    const double half = 0.5 * second.trace();
    if (second.determinant() > least_spread * half * half) {
        plane.lever = second.ldlt().solve(first);
        const double left = plane.weights - plane.lever.dot(first);
        if (left > least_spread * plane.weights) plane.left = left;
    }
    return plane;
}

CornerFits::CornerFits(const FacetSet& facets, std::span<const SurfaceId> chosen_of)
    : chosen(chosen_of.begin(), chosen_of.end()),
      around(with_neighbours(chosen, facets)),
      fit(around.size()),
      row{0} {
    const FacetsAtVertex at_vertex(facets, around);
    // Of each corner the sets of facets that are joined there, and which each facet has.
    std::vector<std::uint32_t> first(at_vertex.size());  // its first number among them
    std::vector<std::uint32_t> number;
    std::vector<std::uint32_t> corner_of;  // (corner) vertex
    corner_of.resize(at_vertex.size());
    for (const SurfaceId f : around) {
        for (const std::uint32_t v : facets.corner[index(f)]) corner_of[at_vertex.place(v)] = v;
    }
    for (std::size_t v = 0; v < at_vertex.size(); ++v) {
        const std::span<const std::uint32_t> here = at_vertex.of(v);
        first[v] = static_cast<std::uint32_t>(number.size());
        const std::size_t begin = size();
        for (const std::uint32_t f : here) {
            std::vector<std::uint32_t> joined;
            for (const std::uint32_t g : here) {
                if (smoothly_joined(facets, f, g)) joined.push_back(g);
            }
            std::size_t c = begin;
            while (c < size() && !std::equal(joined.begin(), joined.end(), other.begin() + row[c],
                                             other.begin() + row[c + 1])) {
                ++c;
            }
            number.push_back(static_cast<std::uint32_t>(c));
            if (c < size()) continue;
            const std::uint32_t corner = corner_of[v];
            const CornerPlane plane = corner_plane(facets, corner, facets.object[f], joined);
            for (const std::uint32_t g : joined) {
                const Eigen::Vector3d away =
                    facets.centroid[g].cast<double>() - facets.vertex[corner].cast<double>();
                const double square = away.squaredNorm();
                other.push_back(g);
                weight.push_back(square > 0.0 ? 1.0 / square : 0.0);
                off.push_back(plane.axes * away);
            }
            row.push_back(static_cast<std::uint32_t>(other.size()));
            lever.push_back(plane.lever);
            left.push_back(plane.left);
            weights.push_back(plane.weights);
        }
    }
    of_chosen.assign(size(), 0);
    for (std::size_t i = 0; i < around.size(); ++i) {
        const auto f = static_cast<std::uint32_t>(index(around[i]));
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t v = at_vertex.place(facets.corner[f][k]);
            const std::span<const std::uint32_t> here = at_vertex.of(v);
            const auto at = std::lower_bound(here.begin(), here.end(), f) - here.begin();
            fit[i][k] = number[first[v] + static_cast<std::size_t>(at)];
        }
    }
    for (const SurfaceId f : chosen) {
        place.push_back(static_cast<std::uint32_t>(
            std::lower_bound(around.begin(), around.end(), f) - around.begin()));
        for (const std::uint32_t c : fit[place.back()]) of_chosen[c] = 1;
    }
}

}  // namespace diurna
