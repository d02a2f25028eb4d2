#include "render/view/linear_facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "materials/base/parallel.hpp"
#include "render/view/pixel_rays.hpp"

namespace diurna {

namespace {

constexpr double steepest = 0.342;      // cosine of 70°
constexpr float one_ground = 0.5f;      // cosine of 60°
constexpr float one_face = 0.94f;       // cosine of 20°
constexpr float shadow_step = 0.02f;    // of the irradiance on a facet across the sun
constexpr float least_spread = 0.1f;    // of neighbours across their line: 1 all around
constexpr float least_kelvins = 1e-4f;  // within a facet

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
    std::span<const std::uint32_t> operator[](std::uint32_t vertex) const {
        const std::uint32_t at = place_[vertex];
        return std::span(facet_).subspan(row_[at], row_[at + 1] - row_[at]);
    }

 private:
    static constexpr auto none = ~std::uint32_t{0};
    std::vector<std::uint32_t> place_, row_{}, facet_{};
};

/// Whether temperatures of two facets belong to one smooth surface.
class Alike {
 public:
    explicit Alike(const FacetHeat& heat)
        : facets_(heat.sun.facets),
          fraction_(heat.sun.fraction),
          to_sun_(heat.sun.to_sun.cast<float>()) {
        if (heat.lit.empty() || fraction_.empty()) return;
        known_.assign(facets_.size(), 0);
        for (const SurfaceId f : heat.lit) known_[index(f)] = 1;
    }

    bool operator()(std::size_t a, std::size_t b) const {
        if (facets_.material[a] != facets_.material[b] || facets_.object[a] != facets_.object[b] ||
            facets_.normal[a].dot(facets_.normal[b]) <
                (facets_.object[a] == ObjectId{0} ? one_ground : one_face)) {
            return false;
        }
        if (fraction_.empty() || !(known(a) && known(b))) return true;
        const float cosine =
            std::min(facets_.normal[a].dot(to_sun_), facets_.normal[b].dot(to_sun_));
        return std::abs(fraction_[a] - fraction_[b]) * std::max(cosine, 0.0f) < shadow_step;
    }

 private:
    bool known(std::size_t f) const { return known_.empty() || known_[f] != 0; }

    const FacetSet& facets_;
    std::span<const float> fraction_;
    Eigen::Vector3f to_sun_;
    std::vector<std::uint8_t> known_{};  // (facet) its share of the sun
};

/// Two unit vectors in which places on a surface are measured: east and north on ground, across the
/// normal n on objects and cliffs, without a jump as it turns (Duff et al. 2017, Journal of
/// Computer Graphics Techniques 6(1), listing 3).
Eigen::Matrix<double, 2, 3> axes_of(const Eigen::Vector3d& n, ObjectId object) {
    if (object == ObjectId{0} && n.z() > steepest) return Eigen::Matrix<double, 2, 3>::Identity();
    const double sign = std::copysign(1.0, n.z());
    const double a = -1.0 / (sign + n.z()), b = n.x() * n.y() * a;
    Eigen::Matrix<double, 2, 3> axes;
    axes << 1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x(),  //
        b, sign + n.y() * n.y() * a, -n.y();
    return axes;
}

/// The surfaces around chosen facets, with their temperatures.
struct Surroundings {
    const FacetSet& facets;
    const FacetsAtVertex& at_vertex;
    const Alike& alike;
    std::span<const float> temperature;

    /// Calls body(other, off, weight) for the facets at a corner that are alike to one of them;
    /// off: of the centroid from the corner [m], weight 1/off².
    template <class Body>
    void each(std::size_t f, std::uint32_t corner, const Body& body) const {
        const Eigen::Vector3d place = facets.vertex[corner].cast<double>();
        for (const std::uint32_t other : at_vertex[corner]) {
            if (!alike(f, other)) continue;
            const Eigen::Vector3d off = facets.centroid[other].cast<double>() - place;
            if (off.squaredNorm() > 0.0) body(other, off, 1.0 / off.squaredNorm());
        }
    }

    /// Temperature at a corner: of the plane that fits the facets around it best, within their
    /// range [K].
    double fitted(std::size_t f, std::uint32_t corner) const {
        // In the plane across their mean normal, the same for all that are alike.
        Eigen::Vector3d normal = Eigen::Vector3d::Zero();
        each(f, corner, [&](std::uint32_t other, const Eigen::Vector3d&, double) {
            normal += facets.normal[other].cast<double>();
        });
        if (!(normal.squaredNorm() > 0.0)) return double{temperature[f]};
        const Eigen::Matrix<double, 2, 3> axes = axes_of(normal.normalized(), facets.object[f]);
        double weights = 0.0, sum = 0.0, low = 1e9, high = -1e9;
        Eigen::Vector2d first = Eigen::Vector2d::Zero(), slope = Eigen::Vector2d::Zero();
        Eigen::Matrix2d second = Eigen::Matrix2d::Zero();
        each(f, corner, [&](std::uint32_t other, const Eigen::Vector3d& away, double weight) {
            const double kelvin = double{temperature[other]};
            const Eigen::Vector2d off = axes * away;
            weights += weight;
            sum += weight * kelvin;
            first += weight * off;
            slope += weight * kelvin * off;
            second += weight * off * off.transpose();
            low = std::min(low, kelvin);
            high = std::max(high, kelvin);
        });
        const double half = 0.5 * second.trace();
        if (second.determinant() > least_spread * half * half) {
            const Eigen::Vector2d lever = second.ldlt().solve(first);
            const double left = weights - lever.dot(first);
            if (left > least_spread * weights) {
                return std::clamp((sum - lever.dot(slope)) / left, low, high);
            }
        }
        return sum / weights;
    }

    /// What the fits at its corners lack of a facet's temperature, on the mean [K].
    double lacking(std::size_t f) const {
        double sum = 0.0;
        for (const std::uint32_t v : facets.corner[f]) sum += fitted(f, v);
        return double{temperature[f]} - sum / 3.0;
    }

    /// The mean at a corner of what the fits lack of the facets around it: what curvature takes
    /// from a fit, which is common to them, while chance mostly cancels [K].
    double common(std::size_t f, std::uint32_t corner, std::span<const float> lacks) const {
        double weights = 0.0, sum = 0.0;
        each(f, corner, [&](std::uint32_t other, const Eigen::Vector3d&, double weight) {
            weights += weight;
            sum += weight * double{lacks[other]};
        });
        return weights > 0.0 ? sum / weights : 0.0;
    }

    /// Range of a facet and its neighbours, relative to it [K].
    void set_range(std::size_t f, FacetSlope& slope) const {
        for (const std::uint32_t v : facets.corner[f]) {
            for (const std::uint32_t other : at_vertex[v]) {
                if (!alike(f, other)) continue;
                slope.low = std::min(slope.low, temperature[other] - temperature[f]);
                slope.high = std::max(slope.high, temperature[other] - temperature[f]);
            }
        }
    }
};

/// lacks  (facet) Ground::lacking, of this facet and its neighbours
FacetSlope slope_of(std::size_t f, const Surroundings& around, std::span<const float> lacks) {
    const FacetSet& facets = around.facets;
    FacetSlope slope;
    around.set_range(f, slope);
    if (slope.high - slope.low < least_kelvins) return slope;
    const auto& corner = facets.corner[f];
    const Eigen::Matrix<float, 2, 3> axes =
        axes_of(facets.normal[f].cast<double>().normalized(), facets.object[f]).cast<float>();
    std::array<Eigen::Vector2f, 3> off;
    Eigen::Vector3f warmer;
    for (std::size_t k = 0; k < 3; ++k) {
        off[k] = axes * (facets.vertex[corner[k]] - facets.centroid[f]);
        const double kelvin = around.fitted(f, corner[k]) + around.common(f, corner[k], lacks);
        warmer[Eigen::Index(k)] =
            std::clamp(float(kelvin - double{around.temperature[f]}), slope.low, slope.high);
    }
    Eigen::Matrix2f sides;
    sides << (off[1] - off[0]).transpose(), (off[2] - off[0]).transpose();
    if (!(std::abs(sides.determinant()) > 0.0f)) return slope;
    const Eigen::Vector2f full =
        sides.inverse() * Eigen::Vector2f(warmer[1] - warmer[0], warmer[2] - warmer[0]);
    const float by_chance = warmer.mean();
    slope.offset =
        by_chance * std::clamp(1.5f - 0.5f * std::abs(by_chance) / chance_difference, 0.0f, 1.0f);
    float share = 1.0f, most = std::abs(slope.offset);
    for (const Eigen::Vector2f& to : off) {
        const float kelvins = full.dot(to);
        if (slope.offset + kelvins > slope.high) {
            share = std::min(share, (slope.high - slope.offset) / kelvins);
        }
        if (slope.offset + kelvins < slope.low) {
            share = std::min(share, (slope.low - slope.offset) / kelvins);
        }
        most = std::max(most, std::abs(kelvins));
    }
    if (share * most < least_kelvins) return {.low = slope.low, .high = slope.high};
    slope.per_metre = share * axes.transpose() * full;
    return slope;
}

/// Facets and all with a common corner, ascending, each once.
std::vector<SurfaceId> with_neighbours(std::span<const SurfaceId> chosen, const FacetSet& facets,
                                       const FacetsAtVertex& at_vertex) {
    std::vector<SurfaceId> all(chosen.begin(), chosen.end());
    for (const SurfaceId f : chosen) {
        for (const std::uint32_t v : facets.corner[index(f)]) {
            for (const std::uint32_t other : at_vertex[v]) all.push_back(SurfaceId{other});
        }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

}  // namespace

std::vector<FacetSlope> facet_slopes(std::span<const SurfaceId> chosen, const FacetHeat& heat) {
    const FacetSet& facets = heat.sun.facets;
    const std::vector<SurfaceId> around =
        with_neighbours(chosen, facets, FacetsAtVertex(facets, chosen));
    const FacetsAtVertex at_vertex(facets, around);
    const Alike alike(heat);
    const Surroundings of{facets, at_vertex, alike, heat.temperature};
    std::vector<float> lacks(facets.size(), 0.0f);
    for_each_index(
        around.size(),
        [&](std::size_t k) { lacks[index(around[k])] = float(of.lacking(index(around[k]))); },
        1024);
    std::vector<FacetSlope> slopes(chosen.size());
    for_each_index(
        chosen.size(), [&](std::size_t k) { slopes[k] = slope_of(index(chosen[k]), of, lacks); },
        1024);
    return slopes;
}

LinearFacets linear_facets(const View& view, const Observer& observer, const FacetHeat& heat) {
    const FacetSet& facets = heat.sun.facets;
    LinearFacets out;
    std::vector<SurfaceId> chosen;
    for (std::size_t t = 0; t < view.surface.size(); ++t) {
        const auto target = static_cast<std::uint32_t>(t);
        if (view.copy_of(target) == no_copy) chosen.push_back(view.surface[t]);
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    const std::vector<FacetSlope> slopes = facet_slopes(chosen, heat);
    std::vector<const FacetSlope*> of_facet(facets.size(), nullptr);
    bool any = false;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        if (slopes[k].flat()) continue;
        of_facet[index(chosen[k])] = &slopes[k];
        any = true;
    }
    if (!any) return out;
    out.warmer.assign(view.sighting.size(), 0.0f);
    out.warmer_centre.assign(view.pixels(), 0.0f);
    const PixelRays eye = pixel_rays(observer);
    const auto width = static_cast<std::size_t>(view.width);
    for_each_block(view.pixels(), 2048, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const double column = double(p % width) + 0.5, row = double(p / width) + 0.5;
            const Eigen::Vector3d from = observer.position + eye.start(column, row);
            const Eigen::Vector3d to = eye.towards(column, row);
            const auto warmer = [&](SurfaceId surface, float range) {
                const FacetSlope* const slope = of_facet[index(surface)];
                if (slope == nullptr) return 0.0f;
                const Eigen::Vector3f at = (from + double{range} * to).cast<float>();
                return slope->at(at - facets.centroid[index(surface)]);
            };
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                if (view.copy_of(s.target) != no_copy) continue;
                out.warmer[k] = warmer(view.surface[s.target], view.range_of(s));
            }
            if (view.centre[p] == no_facet || view.copy_at(p) != no_copy) continue;
            out.warmer_centre[p] = warmer(view.surfaces_at(p).first, view.centre_range[p]);
        }
    });
    return out;
}

}  // namespace diurna
