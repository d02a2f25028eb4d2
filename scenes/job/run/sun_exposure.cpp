#include "scenes/job/run/sun_exposure.hpp"

#include <algorithm>
#include <array>
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

/// No shares are known before.
std::span<const std::uint8_t> nothing(std::size_t, std::span<float>) { return {}; }

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

/// Rows of a kept day one after the other, and the least and greatest of each column's share at an
/// instant and those beside it.
class RangeAbout {
 public:
    explicit RangeAbout(const KeptSun& sun) : sun_(sun) {
        for (std::vector<float>& row : row_) row.resize(sun.columns);
    }
    /// Goes on to the i-th instant, from the one before or to the first.
    void go_to(std::size_t i) {
        if (i == 0) {
            for (std::size_t k = 0; k < 2 && k < sun_.instant.size(); ++k) sun_.decode(k, row_[k]);
        } else if (i + 1 < sun_.instant.size()) {
            sun_.decode(i + 1, row_[(i + 1) % 3]);
        }
        i_ = i;
    }
    float share(std::size_t column) const { return row_[i_ % 3][column]; }
    std::pair<float, float> range(std::size_t column) const {
        const std::size_t first = i_ == 0 ? 0 : i_ - 1,
                          last = std::min(i_ + 1, sun_.instant.size() - 1);
        float low = row_[first % 3][column], high = low;
        for (std::size_t k = first + 1; k <= last; ++k) {
            low = std::min(low, row_[k % 3][column]);
            high = std::max(high, row_[k % 3][column]);
        }
        return {low, high};
    }

 private:
    const KeptSun& sun_;
    std::array<std::vector<float>, 3> row_;  // at the instant's number modulo three
    std::size_t i_ = 0;
};

}  // namespace

KeptSun::KeptSun(const SunExposure& sun)
    : instant(sun.instant),
      edge(sun.edge),
      row(sun.instant.size()),
      columns(sun.fraction.size() / std::max<std::size_t>(1, sun.instant.size())) {
    for_each_index(
        row.size(),
        [&](std::size_t i) {
            const std::span<const float> of = std::span(sun.fraction).subspan(i * columns, columns);
            const auto lit = [](float share) { return share != 0.0f; };
            if (std::none_of(of.begin(), of.end(), lit)) return;
            row[i].kind.reserve(columns);
            for (const float share : of) {
                const bool other = share != 0.0f && share != 1.0f;
                row[i].kind.push_back(other ? 2 : std::uint8_t(share));
                if (other) row[i].share.push_back(share);
            }
            row[i].share.shrink_to_fit();
        },
        1);
}

void KeptSun::decode(std::size_t i, std::span<float> fraction) const {
    const Row& of = row[i];
    if (of.kind.empty()) std::fill(fraction.begin(), fraction.end(), 0.0f);
    std::size_t next = 0;
    for (std::size_t c = 0; c < of.kind.size(); ++c) {
        fraction[c] = of.kind[c] == 2 ? of.share[next++] : float(of.kind[c]);
    }
}

SunExposure KeptSun::until(std::size_t instants) const {
    SunExposure part{.instant = {instant.begin(), instant.begin() + long(instants)},
                     .fraction = std::vector<float>(instants * columns)};
    for (std::size_t i = 0; i < instants; ++i) {
        decode(i, std::span(part.fraction).subspan(i * columns, columns));
    }
    for (const ShadowEdge& one : edge) {
        if (one.step + 1 < instants) part.edge.push_back(one);
    }
    return part;
}

SunExposure scene_sun_exposure(const Prepared& prepared, const std::vector<Instant>& instants) {
    return DailySunExposure(prepared, instants.back()).of(instants);
}

DailySunExposure::DailySunExposure(const Prepared& prepared, Instant end, const StageStore* store)
    : prepared_(prepared),
      light_(prepared.world.facets, prepared.rays, *prepared.world.relief,
             prepared.world.ground_facets, prepared.world.on_detail),
      end_(end),
      store_(store) {}

void DailySunExposure::ask_for(const std::vector<std::uint32_t>& surfaces) {
    const TextureLevels& levels = prepared_.world.texture_levels;
    const auto facet = [&](std::uint32_t s) { return index(levels.facet_of(SurfaceId{s})); };
    asked_for_.assign(prepared_.world.facets.size(), 0);
    for (const std::uint32_t s : surfaces) asked_for_[facet(s)] = 1;
    std::vector<std::uint32_t> column(asked_for_.size());
    facet_.clear();
    for (std::uint32_t f = 0; f < asked_for_.size(); ++f) {
        if (asked_for_[f] == 0) continue;
        column[f] = static_cast<std::uint32_t>(facet_.size());
        facet_.push_back(f);
    }
    column_.clear();
    for (const std::uint32_t s : surfaces) column_.push_back(column[facet(s)]);
}

/// Of facets without textures' levels.
///
/// take_over: sets the shares of some facets at the i-th instant and returns which, (column) 1;
/// empty: none
SunExposure DailySunExposure::cast(const std::vector<Instant>& instants, const TakeOver& take_over,
                                   const EdgesAround& around) const {
    const World& world = prepared_.world;
    const SunFractionOptions options{.samples = prepared_.scene.sun_samples,
                                     .seed = prepared_.scene.seed};
    SunFractionOptions refined = options;
    refined.edge_samples = edge_samples(options.samples);
    const std::size_t facets = world.facets.size();
    const bool all = asked_for_.empty();
    SunExposure sun{.instant = instants, .fraction = {}};
    sun.fraction.assign(instants.size() * columns(), 0.0f);
    std::vector<std::uint8_t> passed_over(all ? 0 : facets, 1);
    std::vector<float> of_all(all ? 0 : facets);
    for (std::size_t i = 0; i < instants.size(); ++i) {
        const std::span<float> row = std::span(sun.fraction).subspan(i * columns(), columns());
        const std::span<const std::uint8_t> known = take_over(i, row);
        const Eigen::Vector3d to_sun = direction(prepared_, instants[i]);
        if (all) {
            light_.sun_fraction(to_sun, row, refined, known);
            continue;
        }
        for (std::size_t k = 0; k < facet_.size(); ++k) {
            passed_over[facet_[k]] = !known.empty() && known[k];
            of_all[facet_[k]] = row[k];
        }
        light_.sun_fraction(to_sun, of_all, refined, passed_over);
        for (std::size_t k = 0; k < facet_.size(); ++k) row[k] = of_all[facet_[k]];
    }
    // When within a step the sun comes and goes: by rays, which answer for single facets.
    std::vector<std::uint32_t> chosen_facets;
    find_edges(
        sun,
        [&](Instant when, std::span<const std::uint32_t> chosen, std::span<float> fraction) {
            const Eigen::Vector3d to_sun = direction(prepared_, when);
            if (all) {
                sun_fraction(world.facets, prepared_.rays, to_sun, chosen, fraction, options);
                return;
            }
            chosen_facets.clear();
            for (const std::uint32_t k : chosen) chosen_facets.push_back(facet_[k]);
            sun_fraction(world.facets, prepared_.rays, to_sun, chosen_facets, of_all, options);
            for (const std::uint32_t k : chosen) fraction[k] = of_all[facet_[k]];
        },
        {.tolerance = 20.0}, around);
    return sun;
}

/// On the surfaces, each lit as its facet is.
SunExposure DailySunExposure::on_all_levels(SunExposure sun) const {
    const TextureLevels& levels = prepared_.world.texture_levels;
    const bool all = asked_for_.empty();
    const bool same =
        column_.size() == facet_.size() && std::is_sorted(column_.begin(), column_.end());
    if (all ? levels.empty() : same) return sun;
    SunExposure on{.instant = std::move(sun.instant), .fraction = {}};
    const std::vector<std::uint32_t>& column = all ? levels.origin : column_;
    on.fraction.resize(on.instant.size() * column.size());
    for_each_index(
        on.instant.size(),
        [&](std::size_t i) {
            float* const to = on.fraction.data() + i * column.size();
            const float* const from = sun.fraction.data() + i * columns();
            for (std::size_t s = 0; s < column.size(); ++s) to[s] = from[column[s]];
        },
        1);
    std::vector<std::uint32_t> first(columns() + 1, 0), place(column.size());
    for (const std::uint32_t c : column) ++first[c + 1];
    for (std::size_t c = 0; c < columns(); ++c) first[c + 1] += first[c];
    std::vector<std::uint32_t> next = first;
    for (std::uint32_t s = 0; s < column.size(); ++s) place[next[column[s]]++] = s;
    for (const ShadowEdge& edge : sun.edge) {
        for (std::uint32_t k = first[edge.facet]; k < first[edge.facet + 1]; ++k) {
            on.edge.push_back({edge.step, place[k], edge.share});
        }
    }
    return on;
}

SunExposure DailySunExposure::of(const std::vector<Instant>& instants) {
    asked_ += double(instants.size()) * columns();
    return on_all_levels(found(instants));
}

SunExposure DailySunExposure::found(const std::vector<Instant>& instants) {
    int since = before_ ? days_between(before_->instant, instants) : -1;
    if (prepared_.scene.exact && since != 0) since = -1;
    const int ahead = after_ ? days_between(before_->instant, after_->instant) : 0;
    if (since == 0 || (since > 0 && since == ahead)) {
        if (since > 0) before_ = std::exchange(after_, std::nullopt);
        taken_over_ += since > 0 ? 0.0 : double(instants.size()) * columns();
        return before_->until(instants.size());
    }
    if (since > 0 && since < ahead) return between_days(instants, double(since) / ahead);
    if (since == 1) {
        const int left = static_cast<int>(
            std::ceil(seconds_between(before_->instant.front(), end_) / day) - 1.0);
        const int alike_days =
            days_alike(prepared_.world.site, before_->instant, left, furthest_deg);
        if (alike_days > 1) {
            after_.emplace(in_full(days_later(before_->instant, alike_days)));
            return between_days(instants, 1.0 / alike_days);
        }
    }
    after_.reset();
    SunExposure sun = in_full(instants);
    if (instants.back() < end_) before_.emplace(sun);
    return sun;
}

SunExposure DailySunExposure::in_full(const std::vector<Instant>& instants) const {
    return cached_or_computed<SunExposure>(
        store_, "sun", [&] { return sun_key(prepared_, instants, asked_for_); }, sun_of,
        [&] { return cast(instants, nothing, {}); });
}

SunExposure DailySunExposure::between_days(const std::vector<Instant>& instants, double share) {
    std::vector<std::uint8_t> known(columns());
    RangeAbout before(*before_), after(*after_);
    const auto take_over = [&](std::size_t i, std::span<float> fraction) {
        before.go_to(i);
        after.go_to(i);
        for_each_index(columns(), [&](std::size_t f) {
            const auto [low, high] = before.range(f);
            const auto [low_after, high_after] = after.range(f);
            known[f] = std::max(high, high_after) - std::min(low, low_after) <= agreeing;
            if (known[f]) fraction[f] = std::lerp(before.share(f), after.share(f), float(share));
        });
        taken_over_ += double(std::count(known.begin(), known.end(), std::uint8_t{1}));
        return std::span<const std::uint8_t>(known);
    };
    return cast(instants, take_over,
                {.before = before_->edge, .after = after_->edge, .share = share});
}

double DailySunExposure::share_taken_over() const {
    return asked_ > 0.0 ? taken_over_ / asked_ : 0.0;
}

}  // namespace diurna
