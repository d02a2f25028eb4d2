#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/store/stage_store.hpp"
#include "terrain/visibility/relief_visibility.hpp"
#include "thermal/solve/shadow_edges.hpp"
#include "thermal/solve/solve_input.hpp"

namespace diurna {

/// Sunlit shares at each of some instants, and the times of shadows' edges between them.
SunExposure scene_sun_exposure(const Prepared& prepared, const std::vector<Instant>& instants);

/// A day's exposure in less memory: most shares are none or all of the sun.
struct KeptSun {
    struct Row {
        std::vector<std::uint8_t> kind;  // (column) 0 none, 1 all, 2 another share; empty: all none
        std::vector<float> share;        // of kind 2, in their order
    };
    std::vector<Instant> instant;
    std::vector<ShadowEdge> edge;
    std::vector<Row> row;  // (instant)
    std::size_t columns = 0;

    explicit KeptSun(const SunExposure& sun);
    void decode(std::size_t i, std::span<float> fraction) const;
    /// Of the first instants.
    SunExposure until(std::size_t instants) const;
};

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
    /// Restricts it to some surfaces, ascending: `of` then has those alone, in this order.
    void ask_for(const std::vector<std::uint32_t>& surfaces);

    /// - instants: of consecutive days, at the same hours; others are computed completely
    SunExposure of(const std::vector<Instant>& instants);

    /// The share of instants and facets that were not recomputed, 0 to 1.
    double share_taken_over() const;

 private:
    /// Columns of the days below.
    std::size_t columns() const {
        return asked_for_.empty() ? prepared_.world.facets.size() : facet_.size();
    }
    std::size_t facet_of(std::size_t column) const {
        return asked_for_.empty() ? column : facet_[column];
    }
    using TakeOver =
        std::function<std::span<const std::uint8_t>(std::size_t i, std::span<float> fraction)>;
    SunExposure cast(const std::vector<Instant>& instants, const TakeOver& take_over,
                     const EdgesAround& around) const;
    SunExposure on_all_levels(SunExposure sun) const;
    SunExposure found(const std::vector<Instant>& instants);
    SunExposure in_full(const std::vector<Instant>& instants) const;
    SunExposure between_days(const std::vector<Instant>& instants, double share);

    const Prepared& prepared_;
    ReliefVisibility light_;
    Instant end_;
    const StageStore* store_;
    std::vector<std::uint8_t> asked_for_{};  // (facet known to rays) 1; empty: all
    std::vector<std::uint32_t> facet_{};     // (column) facet; if only some are needed
    std::vector<std::uint32_t> column_{};    // (surface of those) column of its facet
    std::optional<KeptSun> before_, after_;  // days computed completely, (instant, column)
    double asked_ = 0.0, taken_over_ = 0.0;  // instants and facets
};

}  // namespace diurna
