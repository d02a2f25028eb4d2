#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "scenes/cache/stage_store.hpp"
#include "scenes/plan/prepared.hpp"
#include "terrain/visibility/relief_visibility.hpp"
#include "thermal/solve/solve_input.hpp"

namespace diurna {

/// Who is in the sun at each of some instants, and when between them shadows' edges pass.
SunExposure scene_sun_exposure(const Prepared& prepared, const std::vector<Instant>& instants);

/// The same for one day of a span after the other. From day to day the sun passes the same hours
/// some minutes of arc away, so days are worked out in full only as often as it has moved by
/// `furthest_deg`. Between two of these a facet that both found alike, at the instant and at those
/// beside it, keeps the share that they found; the others' is recomputed.
///
/// What that can miss is what is missed between instants already, which are 2.5° of the sun's way
/// apart at 10 minutes: a shadow narrower than the way between places that agree. On the default
/// scene's hills 2e-4 of the shares are another, and 3 % of the edges, at the most
/// (tests/scenes/sun_exposure_test.cpp).
class DailySunExposure {
 public:
    static constexpr double furthest_deg = 1.25;

    /// - end: of the span; nothing is kept for days after it
    /// - store: of what earlier runs have found; null: none
    DailySunExposure(const Prepared& prepared, Instant end, const StageStore* store = nullptr);
    /// Asks for some facets alone, (facet that rays know) 1; the others are in shadow. Empty: all.
    void ask_for(std::vector<std::uint8_t> facets) { asked_for_ = std::move(facets); }

    /// - instants: of days that follow each other, at the same hours; others are worked out in full
    SunExposure of(const std::vector<Instant>& instants);

    /// The share of instants and facets that were not worked out anew, 0 to 1.
    double share_taken_over() const;

 private:
    std::size_t facets() const { return prepared_.world.facets.size(); }
    SunExposure found(const std::vector<Instant>& instants);
    SunExposure in_full(const std::vector<Instant>& instants) const;
    SunExposure between_days(const std::vector<Instant>& instants, double share);

    const Prepared& prepared_;
    ReliefVisibility light_;
    Instant end_;
    const StageStore* store_;
    std::vector<std::uint8_t> asked_for_{};
    std::optional<SunExposure> before_, after_;  // days worked out in full
    double asked_ = 0.0, taken_over_ = 0.0;      // instants and facets
};

}  // namespace diurna
