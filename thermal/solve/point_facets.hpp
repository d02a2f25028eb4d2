#pragma once

#include <optional>
#include <vector>

#include "thermal/covered_facets.hpp"
#include "thermal/point/point_facet.hpp"
#include "thermal/solve/facet_forcing.hpp"
#include "thermal/solve/facet_point.hpp"
#include "thermal/solve/point_group.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// What a material asks of the solver beyond a linear column under a dry or evenly wet surface.
enum class PointNeed {
    never,
    if_freezing,  // ground whose water may freeze: where a facet falls below 273.15 K
    if_wet,       // a store of water: where it rains, or dew matters; and where ground freezes
    always,       // canopy, snow, regolith, schedules
};
PointNeed point_need(const ThermalSurface& surface);
/// Whether there is water in its layers that may freeze.
bool freezes(const ThermalSurface& surface);

/// The facets of a scene that are solved as points, with the sun, sky and neighbours of the scene:
/// forcing straight between step instants, jumps at shadows' edges. Steps of `SolveOptions::step`
/// (600 s where water stands, if that is less), second order. Side by side where they may
/// (thermal/solve/point_group.hpp), one by one where leaves, regolith or schedules ask for it
/// (thermal/point/point_facet.hpp, some twenty times the time).
///
/// The blocks solve these facets too, as if they were plain: their first guess. A facet is taken in
/// if it needs more: a store of water where rain or snow falls on it, or where dew and hoar on a
/// surface that else is dry would warm it by 0.3 K or more. Where the ground evaporates by itself,
/// dew's heat is in the blocks' balance, and only its way back is skipped. Once taken in, a facet
/// stays for the days that follow.
class PointFacets {
 public:
    explicit PointFacets(const SolveState& solve) : solve_(solve) {}

    /// After a pass of the blocks: takes in who needs it, runs all whose surroundings have changed,
    /// and puts their temperatures in the solve's.
    void pass(SolveState& solve, const Level& level);

    /// Their temperatures once more, where neighbours have moved the solve's since.
    void put(SolveState& solve) const;

    /// Begins with facets that another solve has taken in, from what it left.
    void set_out_from(const std::vector<HeatState::Point>& left);
    /// What lies on them at the solve's instants, of those that hold water, after their last run.
    CoveredFacets cover() const;
    /// What the span leaves of all points.
    std::vector<HeatState::Point> left() const;

    /// Worst of all points that count: of the last run, and (worst_passes) of all runs together.
    struct Summary {
        std::size_t points = 0;
        double residual = 0.0;      // [K] |P(T) − T|, of those whose days do not alternate
        double largest_move = 0.0;  // [K] that the next start is away
        std::size_t worst_facet = 0;
        std::size_t alternating = 0, alternating_facet = 0;  // no repeated day: how many, the worst
        double alternation = 0.0;                            // [K] from one of its days to the next
        std::size_t stores_held = 0;  // what lies on them grows or melts on from day to day
        double store_growth = 0.0;    // [mm] a day of these, the most
        double worst_closure = 0.0;
        int worst_passes = 0, limited = 0;
        int unsolved = 0;                      // steps in which nothing moved
        std::size_t first_unsolved_facet = 0;  // with unsolved: the first of these, and when
        Instant first_unsolved{};
        bool fresh = false;                                   // some were taken in by the last pass
        std::size_t batched = 0, stores = 0, unfollowed = 0;  // as SolveReport reports them
        double most_dew_unfollowed = 0.0, dew_left_out = 0.0, worst_water_closure = 0.0;
    };
    Summary summary() const;

 private:
    void take_in(const Level& level);
    struct Need {
        bool taken = false, unfollowed = false;
        double dew = 0.0, warming = 0.0;
    };
    Need need_of(const Level& level, const Block& block, std::size_t lane,
                 std::vector<double>& warmest) const;
    bool by_itself(const Level& level, const FacetPoint& point) const;
    double mean_kelvin(std::size_t facet) const;  // over the span, as it is in the solve
    void run(const Level& level, FacetPoint& point) const;
    void march_span(const Level& level, const FacetForcing& forcing, PointFacet& facet,
                    FacetPoint& point, Eigen::MatrixXd* map) const;
    bool rests(const FacetPoint& point) const;
    bool counts(const FacetPoint& point) const { return point.facet < solve_.counted; }
    void run_groups(const Level& level, std::vector<FacetPoint*> waiting);

    const SolveState& solve_;
    std::vector<Forcing> weather_;  // (instant)
    std::vector<bool> taken_;       // (facet)
    std::vector<FacetPoint> point_;
    std::vector<std::optional<PointColumn>> column_;  // (kind) of points side by side
    bool rains_ = false, fresh_ = false;
    std::size_t stores_ = 0, batched_ = 0;
    Summary left_out_;  // what was reported of those that were not taken in
};

}  // namespace diurna
