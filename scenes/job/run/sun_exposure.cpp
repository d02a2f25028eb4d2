#include "scenes/job/run/sun_exposure.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "scenes/job/run/sun_on_surfaces.hpp"
#include "scenes/job/store/cached_or_computed.hpp"
#include "scenes/job/store/stage_keys.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "thermal/solve/shadow_edges.hpp"

namespace diurna {

namespace {

constexpr double day = 86400.0;    // [s]
constexpr float agreeing = 0.02f;  // shares of the sun that count as one

Eigen::Vector3d direction(const Prepared& prepared, Instant when) {
    return sun_direction(sun_over(prepared, when));
}

/// Sets the shares of some facets at the i-th instant and returns which, (facet) 1; empty: none.
using TakeOver = std::function<std::span<const std::uint8_t>(std::size_t i, std::span<float>)>;
std::span<const std::uint8_t> nothing(std::size_t, std::span<float>) { return {}; }

/// Of facets without textures' levels.
SunExposure cast(const Prepared& prepared, const ReliefVisibility& light,
                 const std::vector<Instant>& instants, std::span<const std::uint8_t> asked_for,
                 const TakeOver& take_over, const EdgesAround& around) {
    const World& world = prepared.world;
    const SunFractionOptions options{.samples = prepared.scene.sun_samples,
                                     .seed = prepared.scene.seed};
    SunFractionOptions refined = options;
    refined.edge_samples = edge_samples(options.samples);
    const std::size_t facets = world.facets.size();
    SunExposure sun{.instant = instants, .fraction = {}};
    sun.fraction.assign(instants.size() * facets, 0.0f);
    std::vector<std::uint8_t> passed_over(asked_for.size());
    for (std::size_t i = 0; i < instants.size(); ++i) {
        const std::span<float> fraction = std::span(sun.fraction).subspan(i * facets, facets);
        std::span<const std::uint8_t> known = take_over(i, fraction);
        for (std::size_t f = 0; f < asked_for.size(); ++f) {
            passed_over[f] = !asked_for[f] || (!known.empty() && known[f]);
        }
        if (!asked_for.empty()) known = passed_over;
        light.sun_fraction(direction(prepared, instants[i]), fraction, refined, known);
    }
    // When within a step the sun comes and goes: by rays, which answer for single facets.
    find_edges(
        sun,
        [&](Instant when, std::span<const std::uint32_t> chosen, std::span<float> fraction) {
            sun_fraction(world.facets, prepared.rays, direction(prepared, when), chosen, fraction,
                         options);
        },
        {.tolerance = 20.0}, around);
    return sun;
}

/// On the levels of textures too, each lit as its facet is.
SunExposure on_all_levels(const TextureLevels& levels, SunExposure sun) {
    if (levels.empty()) return sun;
    sun.fraction = for_all_levels(levels, sun.fraction);
    std::vector<ShadowEdge> edges;
    for (const ShadowEdge& edge : sun.edge) {
        edges.push_back(edge);
        const SurfacesOfFacet of_facet = levels.surfaces_of(FacetId{edge.facet});
        for (std::uint32_t level = 1; level < of_facet.count; ++level) {
            edges.push_back({edge.step, number(of_facet[level]), edge.share});
        }
    }
    sun.edge = std::move(edges);
    return sun;
}

/// Whole days from one's instants to the other's, which may be fewer; < 0: the hours differ.
int days_between(const std::vector<Instant>& from, const std::vector<Instant>& to) {
    if (to.empty() || to.size() > from.size()) return -1;
    const double days = std::round(seconds_between(from.front(), to.front()) / day);
    for (std::size_t i = 0; i < to.size(); ++i) {
        if (std::abs(seconds_between(from[i], to[i]) - day * days) > 1e-3) return -1;
    }
    return static_cast<int>(days);
}

std::vector<Instant> days_later(std::vector<Instant> instants, int days) {
    for (Instant& when : instants) when = later(when, day * days);
    return instants;
}

/// The furthest day on, 1 to `most`, at whose hours the sun is within some degrees of where it is
/// at theirs.
int days_alike(const Site& site, const std::vector<Instant>& instants, int most, double deg) {
    const auto near = [&](int days) {
        return std::all_of(instants.begin(), instants.end(), [&](Instant when) {
            const SunPosition now = sun_position(site, when);
            const SunPosition then = sun_position(site, later(when, day * days));
            return now.elevation_deg < -1.0 ||
                   sun_direction(now).dot(sun_direction(then)) > std::cos(radians(deg));
        });
    };
    int days = 1;
    while (days < most && near(days + 1)) ++days;
    return days;
}

/// The least and the greatest that a facet's share is at the i-th instant and those beside it.
std::pair<float, float> range_about(const SunExposure& sun, std::size_t facets, std::size_t i,
                                    std::size_t facet) {
    const std::size_t first = i == 0 ? 0 : i - 1, last = std::min(i + 1, sun.instant.size() - 1);
    float low = sun.fraction[first * facets + facet], high = low;
    for (std::size_t k = first + 1; k <= last; ++k) {
        low = std::min(low, sun.fraction[k * facets + facet]);
        high = std::max(high, sun.fraction[k * facets + facet]);
    }
    return {low, high};
}

/// The first `instants` of a day.
SunExposure until(std::size_t instants, const SunExposure& sun, std::size_t facets) {
    if (instants == sun.instant.size()) return sun;
    SunExposure part{
        .instant = {sun.instant.begin(), sun.instant.begin() + long(instants)},
        .fraction = {sun.fraction.begin(), sun.fraction.begin() + long(instants * facets)}};
    for (const ShadowEdge& edge : sun.edge) {
        if (edge.step + 1 < instants) part.edge.push_back(edge);
    }
    return part;
}

}  // namespace

SunExposure scene_sun_exposure(const Prepared& prepared, const std::vector<Instant>& instants) {
    return DailySunExposure(prepared, instants.back()).of(instants);
}

DailySunExposure::DailySunExposure(const Prepared& prepared, Instant end, const StageStore* store)
    : prepared_(prepared),
      light_(prepared.world.facets, prepared.rays, *prepared.world.relief,
             prepared.world.ground_facets, prepared.world.on_detail),
      end_(end),
      store_(store) {}

SunExposure DailySunExposure::of(const std::vector<Instant>& instants) {
    asked_ += double(instants.size()) * facets();
    return on_all_levels(prepared_.world.texture_levels, found(instants));
}

SunExposure DailySunExposure::found(const std::vector<Instant>& instants) {
    int since = before_ ? days_between(before_->instant, instants) : -1;
    if (prepared_.scene.exact && since != 0) since = -1;
    const int ahead = after_ ? days_between(before_->instant, after_->instant) : 0;
    if (since == 0 || (since > 0 && since == ahead)) {
        if (since > 0) before_ = std::exchange(after_, std::nullopt);
        taken_over_ += since > 0 ? 0.0 : double(instants.size()) * facets();
        return until(instants.size(), *before_, facets());
    }
    if (since > 0 && since < ahead) return between_days(instants, double(since) / ahead);
    if (since == 1) {
        const int left = static_cast<int>(
            std::ceil(seconds_between(before_->instant.front(), end_) / day) - 1.0);
        const int alike_days =
            days_alike(prepared_.world.site, before_->instant, left, furthest_deg);
        if (alike_days > 1) {
            after_ = in_full(days_later(before_->instant, alike_days));
            return between_days(instants, 1.0 / alike_days);
        }
    }
    after_.reset();
    SunExposure sun = in_full(instants);
    if (instants.back() < end_) before_ = sun;
    return sun;
}

SunExposure DailySunExposure::in_full(const std::vector<Instant>& instants) const {
    return cached_or_computed<SunExposure>(
        store_, "sun", [&] { return sun_key(prepared_, instants, asked_for_); }, sun_of,
        [&] { return cast(prepared_, light_, instants, asked_for_, nothing, {}); });
}

SunExposure DailySunExposure::between_days(const std::vector<Instant>& instants, double share) {
    std::vector<std::uint8_t> known(facets());
    const auto take_over = [&](std::size_t i, std::span<float> fraction) {
        for_each_index(facets(), [&](std::size_t f) {
            const auto [low, high] = range_about(*before_, facets(), i, f);
            const auto [low_after, high_after] = range_about(*after_, facets(), i, f);
            known[f] = std::max(high, high_after) - std::min(low, low_after) <= agreeing;
            const std::size_t at = i * facets() + f;
            if (known[f]) {
                fraction[f] = std::lerp(before_->fraction[at], after_->fraction[at], float(share));
            }
        });
        taken_over_ += double(std::count(known.begin(), known.end(), std::uint8_t{1}));
        return std::span<const std::uint8_t>(known);
    };
    return cast(prepared_, light_, instants, asked_for_, take_over,
                {.before = before_->edge, .after = after_->edge, .share = share});
}

double DailySunExposure::share_taken_over() const {
    return asked_ > 0.0 ? taken_over_ / asked_ : 0.0;
}

}  // namespace diurna
