#include "terrain/visibility/relief_visibility.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "materials/base/parallel.hpp"
#include "materials/base/random.hpp"
#include "materials/base/units.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/relief/horizon.hpp"
#include "terrain/relief/relief_sun_disc.hpp"
#include "terrain/relief/sky_slice.hpp"
#include "terrain/visibility/sky_basis.hpp"

namespace diurna {

namespace {

constexpr int sky_azimuths = 32;
constexpr float sky_reach = 1e-3f;  // objects that hide less sky are left to the rows' rays
constexpr std::size_t relief_facets_per_block = 1024;
constexpr std::size_t neighbours = 64;  // facets along Morton's curve
constexpr float more_horizon = 0.03f;   // tangent, between azimuths and posts

/// A sun over a horizon given by its tangent.
struct LowSun {
    float radius = static_cast<float>(sun_angular_radius);
    float tangent;              // of its centre's elevation
    float whole_disc, no_disc;  // tangents of horizons that leave all of the disc, or nothing

    explicit LowSun(const Eigen::Vector3d& direction) {
        const double elevation = std::asin(direction.z());
        tangent = static_cast<float>(direction.z() / std::max(1e-6, direction.head<2>().norm()));
        whole_disc = static_cast<float>(std::tan(elevation - sun_angular_radius));
        no_disc = static_cast<float>(
            std::tan(std::min(elevation + sun_angular_radius, 0.5 * std::numbers::pi)));
    }
    /// Radii from the horizon up to the centre. The tangent of the angle between: as good as the
    /// angle within the disc.
    float radii_above(float horizon) const {
        return (tangent - horizon) / ((1.0f + tangent * horizon) * radius);
    }
};

constexpr float steps = 64.0f;  // of MarchedSky::rise
constexpr std::uint8_t most_steps = 255;
std::uint8_t in_steps(float tangent) {
    return static_cast<std::uint8_t>(std::min(std::ceil(tangent * steps), float(most_steps)));
}

/// The azimuths of the march, by number, on either side of each sector, and one further.
std::array<std::pair<int, int>, compass_sectors> azimuths_around_sectors() {
    const auto azimuth = [](double square) {
        const double side = std::floor(square), x = square - side;
        const double from_east = std::atan2(x, 1.0 - x) + 0.5 * std::numbers::pi * side;
        return (0.25 - from_east / (2.0 * std::numbers::pi)) * sky_azimuths - 0.5;
    };
    constexpr double per_side = compass_sectors / 4;
    std::array<std::pair<int, int>, compass_sectors> around;
    for (std::size_t s = 0; s < compass_sectors; ++s) {
        around[s] = {int(std::floor(azimuth((double(s) + 1.0) / per_side))) - 1,
                     int(std::ceil(azimuth(double(s) / per_side))) + 1};
    }
    return around;
}

/// - rise: tangent of the horizon at the i-th azimuth of the march
template <class Rise>
void raise_by_relief(const Rise& rise, OpenAbove& open) {
    static const auto around = azimuths_around_sectors();
    for (std::size_t s = 0; s < compass_sectors; ++s) {
        float most = 0.0f;
        for (int i = around[s].first; i <= around[s].second; ++i) {
            most = std::max(most, rise(std::size_t((i + 2 * sky_azimuths) % sky_azimuths)));
        }
        open[s] = std::max(open[s], most + more_horizon);
    }
}

/// The objects that may hide the sun from facets, which are given in ascending order.
class ObjectsInTheWay {
 public:
    ObjectsInTheWay(const FacetSet& facets, const ObjectBoxes& objects, std::size_t ground,
                    const Eigen::Vector3f& to_sun)
        : facets_(facets), objects_(objects), ground_(ground), to_sun_(to_sun) {
        all_.resize(objects.size());
        std::iota(all_.begin(), all_.end(), 0u);
    }
    bool may_shade(std::size_t facet) {
        if (facet >= end_) {
            const std::size_t begin = facet / neighbours * neighbours;
            end_ = std::min(begin + neighbours, ground_);
            Eigen::AlignedBox3f box;
            for (std::size_t f = begin; f < end_; ++f) box.extend(box_around(facets_, f));
            objects_.shading(box, to_sun_, all_, found_);
        }
        return objects_.may_shade(box_around(facets_, facet), to_sun_, found_);
    }

 private:
    const FacetSet& facets_;
    const ObjectBoxes& objects_;
    std::size_t ground_, end_ = 0;
    Eigen::Vector3f to_sun_;
    std::vector<std::uint32_t> all_, found_{};
};

}  // namespace

ReliefVisibility::ReliefVisibility(const FacetSet& facets, const RayScene& rays,
                                   const HeightField& relief, std::size_t ground_facets,
                                   std::span<const std::uint8_t> finer)
    : facets_(facets),
      rays_(rays),
      relief_(relief),
      points_(facets, relief, ground_facets),
      objects_(facets, ground_facets, rays.copies()),
      always_(facets.size(), 0) {
    assert(ground_facets <= facets.size());
    assert(finer.empty() || finer.size() == ground_facets);
    std::fill(always_.begin() + static_cast<std::ptrdiff_t>(ground_facets), always_.end(), 1);
    if (ground_facets < facets.size()) {
        raised_ = raised_relief(facets, relief, ground_facets, rays.copies());
        if (raised_) beside_.assign(ground_facets, 0);
    }
    for (std::size_t f = 0; f < ground_facets; ++f) {
        if (points_.off_relief(f) || (!finer.empty() && finer[f])) always_[f] = 1;
        if (!raised_) continue;
        for (const ReliefPoint& p : points_.of(f)) {
            for (const std::size_t post : points_.posts_round(p)) {
                if (raised_->touched[post]) beside_[f] = 1;
            }
        }
    }
}

ReliefVisibility::Horizons ReliefVisibility::horizons_near(const Eigen::Vector3d& direction) const {
    Horizons horizons;
    horizons.relief.resize(relief_.size());
    horizon_near(relief_, direction, sun_angular_radius, horizons.relief);
    if (raised_) {
        horizons.raised.resize(relief_.size());
        horizon_near(raised_->relief, direction, sun_angular_radius, horizons.raised);
    }
    return horizons;
}

/// The horizons at all posts round a facet's points.
ReliefVisibility::Span ReliefVisibility::around(std::size_t facet,
                                                const std::vector<float>& tangent) const {
    Span span{1e30f, -1e30f};
    for (const ReliefPoint& p : points_.of(facet)) {
        for (const std::size_t post : points_.posts_round(p)) {
            span.low = std::min(span.low, tangent[post]);
            span.high = std::max(span.high, tangent[post]);
        }
    }
    return span;
}

bool ReliefVisibility::objects_matter(std::size_t facet, const Horizons& horizons) const {
    if (!raised_) return false;
    for (const ReliefPoint& p : points_.of(facet)) {
        for (const std::size_t post : points_.posts_round(p)) {
            if (horizons.raised[post] > horizons.relief[post]) return true;
        }
    }
    return false;
}

std::size_t ReliefVisibility::sun_fraction(const Eigen::Vector3d& direction,
                                           std::span<float> fraction,
                                           const SunFractionOptions& options,
                                           std::span<const std::uint8_t> known) const {
    assert(fraction.size() == facets_.size());
    const auto is_known = [&](std::size_t f) { return !known.empty() && known[f]; };
    if (direction.z() <= 0.0) {
        std::fill(fraction.begin(), fraction.end(), 0.0f);  // of known ones too
        return 0;
    }
    static const DiscTable disc;
    const Horizons horizons = horizons_near(direction);
    const Eigen::Vector3f towards = direction.cast<float>();
    const LowSun sun(direction);
    const auto mean_light = [&](std::size_t f) {
        float sum = 0.0f;
        for (const ReliefPoint& p : points_.of(f)) {
            const float seen = disc(sun.radii_above(points_.at(p, horizons.relief)));
            if (seen > 0.0f) sum += seen * std::max(0.0f, points_.grid_normal(p).dot(towards));
        }
        return sum / static_cast<float>(points_.of(f).size());
    };

    std::vector<std::uint8_t> by_rays = always_;
    for_each_block(points_.facets(), relief_facets_per_block,
                   [&](std::size_t begin, std::size_t end) {
                       ObjectsInTheWay objects(facets_, objects_, points_.facets(), towards);
                       for (std::size_t f = begin; f < end; ++f) {
                           if (by_rays[f] || is_known(f)) continue;
                           fraction[f] = 0.0f;
                           const float cosine = facets_.normal[f].dot(towards);
                           if (cosine <= -sun.radius) continue;
                           const bool near = raised_ && (beside_[f] || objects_matter(f, horizons));
                           if (near && objects.may_shade(f)) {
                               by_rays[f] = 1;
                               continue;
                           }
                           if (points_.coarse(f)) {
                               if (cosine > 0.0f) fraction[f] = mean_light(f) / cosine;
                               continue;
                           }
                           const Span horizon = around(f, horizons.relief);
                           if (horizon.low >= sun.no_disc) continue;
                           if (horizon.high <= sun.whole_disc) {
                               fraction[f] = disc(cosine / sun.radius);
                           } else {
                               by_rays[f] = 1;
                           }
                       }
                   });
    std::vector<std::uint32_t> chosen;
    for (std::size_t f = 0; f < by_rays.size(); ++f) {
        if (by_rays[f] && !is_known(f)) chosen.push_back(static_cast<std::uint32_t>(f));
    }
    diurna::sun_fraction(facets_, rays_, direction, chosen, fraction, options);
    return chosen.size();
}

ReliefVisibility::MarchedSky ReliefVisibility::marched_sky() const {
    static const SlopeTable slope;
    MarchedSky sky;
    sky.seen.assign(points_.facets(), 0.0f);
    sky.below_objects.assign(points_.facets(), 0.0f);
    sky.rise.assign(points_.facets() * sky_azimuths, 0);
    Horizons horizons;
    horizons.relief.resize(relief_.size());
    if (raised_) horizons.raised.resize(relief_.size());
    for (int i = 0; i < sky_azimuths; ++i) {
        const double azimuth_deg = 360.0 * (i + 0.5) / sky_azimuths;
        const Eigen::Vector2f way = direction(azimuth_deg, 0.0).head<2>().cast<float>();
        horizon(relief_, azimuth_deg, horizons.relief);
        if (raised_) horizon(raised_->relief, azimuth_deg, horizons.raised);
        for_each_block(
            points_.facets(), relief_facets_per_block, [&](std::size_t begin, std::size_t end) {
                for (std::size_t f = begin; f < end; ++f) {
                    if (always_[f] || (raised_ && beside_[f])) continue;
                    const float rise = around(f, raised_ ? horizons.raised : horizons.relief).high;
                    sky.rise[f * sky_azimuths + std::size_t(i)] = in_steps(rise);
                    const auto points = static_cast<float>(points_.of(f).size());
                    for (const ReliefPoint& p : points_.of(f)) {
                        const Eigen::Vector3f normal =
                            points_.coarse(f) ? points_.grid_normal(p) : facets_.normal[f];
                        const auto slice = [&](const std::vector<float>& tangent) {
                            return sky_slice(slope, normal, way, points_.at(p, tangent)) / points;
                        };
                        sky.seen[f] += slice(horizons.relief);
                        if (raised_) sky.below_objects[f] += slice(horizons.raised);
                    }
                }
            });
    }
    return sky;
}

std::vector<OpenAbove> ReliefVisibility::skylines(std::span<const std::uint32_t> chosen) const {
    std::vector<std::array<float, sky_azimuths>> rises(chosen.size());
    std::vector<float> tangent(relief_.size());
    for (int i = 0; i < sky_azimuths && !chosen.empty(); ++i) {
        horizon(relief_, 360.0 * (i + 0.5) / sky_azimuths, tangent);
        for_each_index(chosen.size(), [&](std::size_t k) {
            rises[k][std::size_t(i)] = around(chosen[k], tangent).high;
        });
    }
    std::vector<OpenAbove> skyline(chosen.size());
    for_each_block(chosen.size(), neighbours, [&](std::size_t begin, std::size_t end) {
        Eigen::AlignedBox3f around_all;
        for (std::size_t k = begin; k < end; ++k) {
            around_all.extend(box_around(facets_, chosen[k]));
        }
        const auto [far, near] = objects_.far_and_near(around_all);
        OpenAbove of_far{};
        objects_.raise(around_all, far, of_far);
        for (std::size_t k = begin; k < end; ++k) {
            skyline[k] = of_far;
            objects_.raise(box_around(facets_, chosen[k]), near, skyline[k]);
            raise_by_relief([&](std::size_t i) { return rises[k][i]; }, skyline[k]);
        }
    });
    return skyline;
}

bool ReliefVisibility::sees_objects(const MarchedSky& marched, std::size_t facet) const {
    return raised_ && (beside_[facet] || marched.seen[facet] - marched.below_objects[facet] >
                                             sky_reach * sky_azimuths);
}

FacetViews ReliefVisibility::facet_views(const FacetViewOptions& options) const {
    const MarchedSky marched = marched_sky();
    std::vector<std::uint8_t> near_objects(beside_.size(), 0);
    for (std::size_t f = 0; f < near_objects.size(); ++f)
        near_objects[f] = sees_objects(marched, f);
    std::vector<std::uint32_t> chosen, skyline_of(near_objects.size());
    for (std::size_t f = 0; f < near_objects.size(); ++f) {
        if (!near_objects[f] || always_[f]) continue;  // where no relief is known: all rays
        skyline_of[f] = static_cast<std::uint32_t>(chosen.size());
        chosen.push_back(static_cast<std::uint32_t>(f));
    }
    const std::vector<OpenAbove> known = skylines(chosen);
    FacetViewOptions by_rays = options;
    by_rays.near_objects = near_objects;
    by_rays.open_above = [&](std::size_t f, OpenAbove& open) {
        if (always_[f]) return false;
        if (f < near_objects.size() && near_objects[f]) {
            open = known[skyline_of[f]];
            return true;
        }
        const std::uint8_t* const rise = &marched.rise[f * sky_azimuths];
        open.fill(0.0f);
        raise_by_relief([&](std::size_t i) { return float(rise[i]) * (1.0f / steps); }, open);
        return *std::max_element(rise, rise + sky_azimuths) < most_steps;
    };
    FacetViews views = diurna::facet_views(facets_, rays_, by_rays);
    for_each_block(points_.facets(), relief_facets_per_block,
                   [&](std::size_t begin, std::size_t end) {
                       for (std::size_t f = begin; f < end; ++f) {
                           if (always_[f] || sees_objects(marched, f)) continue;
                           const float sky = std::clamp(marched.seen[f] / sky_azimuths, 0.0f, 1.0f);
                           const float rest = 1.0f - views.sky[f];
                           views.shares[f] = with_sky_view(views.shares[f], facets_.normal[f],
                                                           double{views.sky[f]}, double{sky});
                           views.sky[f] = sky;
                           if (rest <= 0.0f) {
                               views.below[f] = 1.0f - sky;
                               continue;
                           }
                           const float scale = (1.0f - sky) / rest;
                           views.below[f] *= scale;
                           if (!views.hidden.empty()) views.hidden[f] *= scale;
                           for (auto k = views.others.row[f]; k < views.others.row[f + 1]; ++k) {
                               views.others.factor[k] *= scale;
                           }
                           if (views.copied.row.empty()) continue;
                           for (auto k = views.copied.row[f]; k < views.copied.row[f + 1]; ++k) {
                               views.copied.factor[k] *= scale;
                           }
                       }
                   });
    return views;
}

}  // namespace diurna
