#include "render/view/linear_ground.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "materials/base/parallel.hpp"
#include "render/view/pixel_rays.hpp"

namespace diurna {

namespace {

constexpr float steepest = 0.342f;      // cosine of 70°
constexpr float one_surface = 0.5f;     // cosine of 60°
constexpr float shadow_step = 0.02f;    // of the irradiance on a facet across the sun
constexpr float least_spread = 0.1f;    // of neighbours across their line: 1 all around
constexpr float least_kelvins = 1e-4f;  // within a facet

/// The facet that rays know in the place of each, if it is ground.
struct GroundPlace {
    std::size_t ground_facets;
    const TextureLevels* levels;
    bool operator()(std::size_t facet) const {
        const bool textured = levels != nullptr && !levels->empty();
        return (textured ? levels->origin[facet] : facet) < ground_facets;
    }
};

/// Facets of the ground at some vertices, in compressed rows.
class GroundAtVertex {
 public:
    GroundAtVertex(const FacetSet& facets, std::span<const FacetId> chosen, GroundPlace is_ground)
        : place_(facets.vertex.size(), none) {
        std::uint32_t count = 0;
        for (const FacetId f : chosen) {
            for (const std::uint32_t v : facets.corner[index(f)]) {
                if (place_[v] == none) place_[v] = count++;
            }
        }
        row_.assign(count + 1, 0);
        const auto each = [&](const auto& body) {
            for (std::size_t f = 0; f < facets.size(); ++f) {
                if (!is_ground(f)) continue;
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
    explicit Alike(const GroundHeat& heat)
        : facets_(heat.sun.facets),
          fraction_(heat.sun.fraction),
          to_sun_(heat.sun.to_sun.cast<float>()) {
        if (heat.lit.empty() || fraction_.empty()) return;
        known_.assign(facets_.size(), 0);
        for (const FacetId f : heat.lit) known_[index(f)] = 1;
    }

    bool operator()(std::size_t a, std::size_t b) const {
        if (facets_.material[a] != facets_.material[b] || facets_.object[a] != facets_.object[b] ||
            facets_.normal[a].dot(facets_.normal[b]) < one_surface) {
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

FacetSlope slope_of(std::size_t f, const FacetSet& facets, const GroundAtVertex& at_vertex,
                    const Alike& alike, std::span<const float> temperature) {
    FacetSlope slope;
    if (facets.normal[f].z() < steepest) return slope;
    const auto& corner = facets.corner[f];
    const auto has = [&](std::uint32_t other, std::size_t k) {
        const auto& of = facets.corner[other];
        return std::find(of.begin(), of.end(), corner[k]) != of.end();
    };
    const Eigen::Vector2f middle = facets.centroid[f].head<2>();
    Eigen::Matrix2f spread = Eigen::Matrix2f::Zero();
    Eigen::Vector2f rise = Eigen::Vector2f::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
        for (const std::uint32_t other : at_vertex[corner[k]]) {
            // Each once, though it may have two of these corners.
            if (other == f || (k > 0 && has(other, 0)) || (k > 1 && has(other, 1))) continue;
            if (!alike(f, other)) continue;
            const Eigen::Vector2f to = facets.centroid[other].head<2>() - middle;
            const float squared = to.squaredNorm();
            if (!(squared > 0.0f)) continue;
            const float kelvins = temperature[other] - temperature[f];
            spread += to * to.transpose() / squared;
            rise += to * (kelvins / squared);
            slope.low = std::min(slope.low, kelvins);
            slope.high = std::max(slope.high, kelvins);
        }
    }
    const float half = 0.5f * spread.trace();
    if (!(spread.determinant() > least_spread * half * half)) return slope;
    const Eigen::Vector2f full = spread.inverse() * rise;
    float share = 1.0f, most = 0.0f;
    for (const std::uint32_t v : corner) {
        const float kelvins = full.dot(facets.vertex[v].head<2>() - middle);
        if (kelvins > slope.high) share = std::min(share, slope.high / kelvins);
        if (kelvins < slope.low) share = std::min(share, slope.low / kelvins);
        most = std::max(most, std::abs(kelvins));
    }
    if (share * most < least_kelvins) return slope;
    slope.per_metre = share * full;
    return slope;
}

}  // namespace

std::vector<FacetSlope> facet_slopes(std::span<const FacetId> chosen, const GroundHeat& heat) {
    const FacetSet& facets = heat.sun.facets;
    const GroundAtVertex at_vertex(facets, chosen, {heat.ground_facets, heat.levels});
    const Alike alike(heat);
    std::vector<FacetSlope> slopes(chosen.size());
    for_each_index(
        chosen.size(),
        [&](std::size_t k) {
            slopes[k] = slope_of(index(chosen[k]), facets, at_vertex, alike, heat.temperature);
        },
        1024);
    return slopes;
}

LinearGround linear_ground(const View& view, const Observer& observer, const GroundHeat& heat) {
    const FacetSet& facets = heat.sun.facets;
    LinearGround out;
    const GroundPlace is_ground{heat.ground_facets, heat.levels};
    std::vector<FacetId> chosen;
    for (std::size_t t = 0; t < view.facet.size(); ++t) {
        const auto target = static_cast<std::uint32_t>(t);
        if (view.copy_of(target) == no_copy && is_ground(index(view.facet[t]))) {
            chosen.push_back(view.facet[t]);
        }
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    const std::vector<FacetSlope> slopes = facet_slopes(chosen, heat);
    std::vector<const FacetSlope*> of_facet(facets.size(), nullptr);
    bool any = false;
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        if (slopes[k].per_metre.isZero()) continue;
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
            const auto warmer = [&](FacetId facet, float range) {
                const FacetSlope* const slope = of_facet[index(facet)];
                if (slope == nullptr) return 0.0f;
                const Eigen::Vector2f at = (from + double{range} * to).head<2>().cast<float>();
                return slope->at(at - facets.centroid[index(facet)].head<2>());
            };
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                if (view.copy_of(s.target) != no_copy) continue;
                out.warmer[k] = warmer(view.facet[s.target], view.range_of(s));
            }
            if (view.centre[p] == no_facet || view.copy_at(p) != no_copy) continue;
            const FacetId centre =
                view.centre_blend.empty() ? view.centre[p] : view.centre_blend[p].first;
            out.warmer_centre[p] = warmer(centre, view.centre_range[p]);
        }
    });
    return out;
}

}  // namespace diurna
