#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/store/stage_store.hpp"
#include "terrain/visibility/relief_visibility.hpp"
#include "thermal/solve/solve_input.hpp"

namespace diurna {

/// Sunlit shares at each of some instants, and the times of shadows' edges between them.
SunExposure scene_sun_exposure(const Prepared& prepared, const std::vector<Instant>& instants);

/// The same for the days of a span in sequence. From day to day the sun is displaced by some
/// minutes of arc at the same hour, so days are computed completely only as often as it has moved
/// by `furthest_deg`. Between two of these a facet with equal shares in both, at the instant and at
/// its neighbours, keeps that share; the others are recomputed.
///
/// This can miss only what is already missed between instants, which are 2.5°
/// of the sun's path apart at 10 minutes: a shadow narrower than the distance
/// between places that agree. On the default scene's hills at most 2e-4 of
/// the shares differ, and 3 % of the edges
/// (tests/scenes/sun_exposure_test.cpp).
class DailySunExposure {
 public:
    static constexpr double furthest_deg = 1.25;

    /// - end: of the span; nothing is stored for days after it
    /// - store: cache of earlier results; null: none
    DailySunExposure(const Prepared& prepared, Instant end, const StageStore* store = nullptr);
    /// Restricts it to some facets, (facet known to rays) 1; others are in shadow. Empty:
    /// all.
    void ask_for(std::vector<std::uint8_t> facets) { asked_for_ = std::move(facets); }

    /// - instants: of consecutive days, at the same hours; others are computed completely
    SunExposure of(const std::vector<Instant>& instants);

    /// The share of instants and facets that were not recomputed, 0 to 1.
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
    std::optional<SunExposure> before_, after_;  // days computed completely
    double asked_ = 0.0, taken_over_ = 0.0;      // instants and facets
};

}  // namespace diurna
