#include "render/view/linear_facets.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "materials/base/parallel.hpp"
#include "render/view/pixel_rays.hpp"

namespace diurna {

namespace {

constexpr float shadow_step = 0.02f;    // of the irradiance on a facet across the sun
constexpr float least_kelvins = 1e-4f;  // within a facet

/// Whether facets are on one side of the edge of a shadow.
class SameLight {
 public:
    explicit SameLight(const FacetHeat& heat)
        : facets_(heat.sun.facets),
          fraction_(heat.sun.fraction),
          to_sun_(heat.sun.to_sun.cast<float>()) {
        if (heat.lit.empty() || fraction_.empty()) return;
        known_.assign(facets_.size(), 0);
        for (const SurfaceId f : heat.lit) known_[index(f)] = 1;
    }

    bool operator()(std::size_t a, std::size_t b) const {
        if (fraction_.empty() || !(known(a) && known(b))) return true;
        const float cosine =
            std::min(facets_.normal[a].dot(to_sun_), facets_.normal[b].dot(to_sun_));
        return std::abs(fraction_[a] - fraction_[b]) * std::max(cosine, 0.0f) < shadow_step;
    }
    /// Whether any two of them are.
    bool of_all(std::span<const std::uint32_t> some) const {
        if (fraction_.empty()) return true;
        float least = 1.0f, most = 0.0f;
        for (const std::uint32_t f : some) {
            if (!known(f)) continue;
            least = std::min(least, fraction_[f]);
            most = std::max(most, fraction_[f]);
        }
        if (most - least < shadow_step) return true;
        for (std::size_t i = 0; i < some.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (!(*this)(some[i], some[j])) return false;
            }
        }
        return true;
    }

 private:
    bool known(std::size_t f) const { return known_.empty() || known_[f] != 0; }

    const FacetSet& facets_;
    std::span<const float> fraction_;
    Eigen::Vector3f to_sun_;
    std::vector<std::uint8_t> known_{};  // (facet) its share of the sun
};

/// Temperatures at corners, of the planes that fit the facets around them best. Where a shadow's
/// edge parts these, each facet has a fit of its own.
class CornerHeat {
 public:
    CornerHeat(const CornerFits& fits, const FacetHeat& heat)
        : facets_(heat.sun.facets),
          fits_(fits),
          temperature_(heat.temperature),
          same_light_(heat),
          whole_(fits.size()) {
        for_each_index(
            fits.size(), [&](std::size_t c) { whole_[c] = found(c); }, 1024);
        lacks_.assign(facets_.size(), 0.0f);
        for_each_index(
            fits.around.size(),
            [&](std::size_t i) {
                const std::size_t f = index(fits.around[i]);
                lacks_[f] = static_cast<float>(lacking(f, fits.fit[i]));
            },
            1024);
        for_each_index(
            fits.size(),
            [&](std::size_t c) {
                if (fits.of_chosen[c] && whole_[c].one)
                    whole_[c].common = common(c, [](std::size_t) { return true; });
            },
            1024);
    }

    /// Temperature at a corner, with what the fits lack of the facets around it on the mean: what
    /// curvature takes from a fit, which is common to them, while chance mostly cancels [K].
    double at(std::size_t f, std::uint32_t corner, std::uint32_t c) const {
        if (whole_[c].one) return whole_[c].value + whole_[c].common;
        return fitted(f, corner, c) + common(c, [&](std::size_t e) { return joined(f, e); });
    }
    float temperature(std::size_t f) const { return temperature_[f]; }

    /// Range of a facet and its neighbours, relative to it [K].
    void set_range(std::size_t f, const std::array<std::uint32_t, 3>& fit,
                   FacetSlope& slope) const {
        const auto include = [&](float low, float high) {
            slope.low = std::min(slope.low, low - temperature_[f]);
            slope.high = std::max(slope.high, high - temperature_[f]);
        };
        for (const std::uint32_t c : fit) {
            if (whole_[c].one) {
                include(whole_[c].low, whole_[c].high);
                continue;
            }
            for (std::uint32_t e = fits_.row[c]; e < fits_.row[c + 1]; ++e) {
                const float kelvin = temperature_[fits_.other[e]];
                if (joined(f, e)) include(kelvin, kelvin);
            }
        }
    }

 private:
    struct Fit {
        bool one = false;  // for all its facets
        float low = 1e9f, high = -1e9f;
        double value = 0.0, common = 0.0;
    };
    std::span<const std::uint32_t> others(std::size_t c) const {
        return std::span(fits_.other).subspan(fits_.row[c], fits_.row[c + 1] - fits_.row[c]);
    }
    bool joined(std::size_t f, std::size_t entry) const {
        return same_light_(f, fits_.other[entry]);
    }

    Fit found(std::size_t c) const {
        Fit fit{.one = fits_.weights[c] > 0.0 && same_light_.of_all(others(c))};
        if (!fit.one) return fit;
        double sum = 0.0;
        Eigen::Vector2d slope = Eigen::Vector2d::Zero();
        for (std::uint32_t e = fits_.row[c]; e < fits_.row[c + 1]; ++e) {
            const float kelvin = temperature_[fits_.other[e]];
            const double weighted = fits_.weight[e] * double{kelvin};
            sum += weighted;
            slope += weighted * fits_.off[e];
            fit.low = std::min(fit.low, kelvin);
            fit.high = std::max(fit.high, kelvin);
        }
        fit.value = fits_.left[c] > 0.0
                        ? std::clamp((sum - fits_.lever[c].dot(slope)) / fits_.left[c],
                                     double{fit.low}, double{fit.high})
                        : sum / fits_.weights[c];
        return fit;
    }

    /// Of the facets that are in the light of one of them.
    double fitted(std::size_t f, std::uint32_t corner, std::size_t c) const {
        std::vector<std::uint32_t> some;
        for (std::uint32_t e = fits_.row[c]; e < fits_.row[c + 1]; ++e) {
            if (joined(f, e)) some.push_back(fits_.other[e]);
        }
        const CornerPlane plane = corner_plane(facets_, corner, facets_.object[f], some);
        if (!(plane.weights > 0.0)) return double{temperature_[f]};
        double sum = 0.0, low = 1e9, high = -1e9;
        Eigen::Vector2d slope = Eigen::Vector2d::Zero();
        for (std::uint32_t e = fits_.row[c]; e < fits_.row[c + 1]; ++e) {
            if (!joined(f, e) || fits_.weight[e] == 0.0) continue;
            const std::uint32_t other = fits_.other[e];
            const double kelvin = double{temperature_[other]};
            const Eigen::Vector2d off = plane.axes * (facets_.centroid[other].cast<double>() -
                                                      facets_.vertex[corner].cast<double>());
            sum += fits_.weight[e] * kelvin;
            slope += fits_.weight[e] * kelvin * off;
            low = std::min(low, kelvin);
            high = std::max(high, kelvin);
        }
        if (!(plane.left > 0.0)) return sum / plane.weights;
        return std::clamp((sum - plane.lever.dot(slope)) / plane.left, low, high);
    }

    /// What the fits at its corners lack of a facet's temperature, on the mean [K].
    double lacking(std::size_t f, const std::array<std::uint32_t, 3>& fit) const {
        double sum = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            sum +=
                whole_[fit[k]].one ? whole_[fit[k]].value : fitted(f, facets_.corner[f][k], fit[k]);
        }
        return double{temperature_[f]} - sum / 3.0;
    }

    template <class Counts>
    double common(std::size_t c, const Counts& counts) const {
        double weights = 0.0, sum = 0.0;
        for (std::uint32_t e = fits_.row[c]; e < fits_.row[c + 1]; ++e) {
            if (!counts(e)) continue;
            weights += fits_.weight[e];
            sum += fits_.weight[e] * double{lacks_[fits_.other[e]]};
        }
        return weights > 0.0 ? sum / weights : 0.0;
    }

    const FacetSet& facets_;
    const CornerFits& fits_;
    std::span<const float> temperature_;
    SameLight same_light_;
    std::vector<Fit> whole_;
    std::vector<float> lacks_{};  // (facet)
};

/// - fit: at its corners
FacetSlope slope_of(const FacetSet& facets, std::size_t f, const CornerHeat& heat,
                    const std::array<std::uint32_t, 3>& fit) {
    FacetSlope slope;
    heat.set_range(f, fit, slope);
    if (slope.high - slope.low < least_kelvins) return slope;
    const auto& corner = facets.corner[f];
    const Eigen::Matrix<float, 2, 3> axes =
        surface_axes(facets.normal[f].cast<double>().normalized(), facets.object[f]).cast<float>();
    std::array<Eigen::Vector2f, 3> off;
    Eigen::Vector3f warmer;
    for (std::size_t k = 0; k < 3; ++k) {
        off[k] = axes * (facets.vertex[corner[k]] - facets.centroid[f]);
        const double kelvin = heat.at(f, corner[k], fit[k]);
        warmer[Eigen::Index(k)] =
            std::clamp(float(kelvin - double{heat.temperature(f)}), slope.low, slope.high);
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

}  // namespace

std::vector<FacetSlope> facet_slopes(const CornerFits& fits, const FacetHeat& heat) {
    const CornerHeat corners(fits, heat);
    std::vector<FacetSlope> slopes(fits.chosen.size());
    for_each_index(
        slopes.size(),
        [&](std::size_t k) {
            slopes[k] =
                slope_of(heat.sun.facets, index(fits.chosen[k]), corners, fits.fit[fits.place[k]]);
        },
        1024);
    return slopes;
}

std::vector<SurfaceId> facets_with_slopes(const View& view) {
    std::vector<SurfaceId> chosen;
    for (std::size_t t = 0; t < view.surface.size(); ++t) {
        const auto target = static_cast<std::uint32_t>(t);
        if (view.copy_of(target) == no_copy) chosen.push_back(view.surface[t]);
    }
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return chosen;
}

LinearFacets linear_facets(const View& view, const Observer& observer, const CornerFits& fits,
                           const FacetHeat& heat) {
    const FacetSet& facets = heat.sun.facets;
    const std::vector<SurfaceId>& chosen = fits.chosen;
    LinearFacets out;
    const std::vector<FacetSlope> slopes = facet_slopes(fits, heat);
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
