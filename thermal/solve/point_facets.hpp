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

/// When a material needs more than a linear column under a dry or evenly wet surface.
enum class PointNeed {
    never,
    if_freezing,  // ground with water: if a facet falls below 273.15 K
    if_wet,       // a water store: with rain or significant dew; and if ground freezes
    always,       // canopy, snow, regolith, schedules
};
PointNeed point_need(const ThermalSurface& surface);
/// Whether its layers contain water that may freeze.
bool freezes(const ThermalSurface& surface);

/// The facets of a scene that are solved as points, with the sun, sky and neighbours of the scene:
/// inputs linear between step instants, jumps at shadows' edges. Steps of `SolveOptions::step` (600
/// s with water, if that is less), second order. In lanes if possible
/// (thermal/solve/point_group.hpp), individually for leaves, regolith or schedules
/// (thermal/point/point_facet.hpp, about twenty times slower).
///
/// The blocks solve these facets too, with the simple surface: their first guess. A facet becomes a
/// point if it needs more: a store of water with rain or snow, or dew and hoar that would warm an
/// otherwise dry surface by 0.3 K or more. If the ground evaporates by itself, dew's heat is in the
/// blocks' balance, and only its later evaporation is skipped. A point stays a point for the
/// following days.
class PointFacets {
 public:
    explicit PointFacets(const SolveState& solve) : solve_(solve) {}

    /// After a pass of the blocks: adds the facets that need it, runs all points whose surroundings
    /// have changed, and stores their temperatures in the solve.
    void pass(SolveState& solve, const Level& level);

    /// Dew on the facets that stay in blocks, as warm as they have become, for the summary.
    void measure_left_out(const Level& level);

    /// Stores their temperatures again, after updates by neighbours.
    void put(SolveState& solve) const;

    /// Starts from the points of another solve, with their end state.
    void set_out_from(const std::vector<HeatState::Point>& left);
    /// Water and snow on points with a store at the solve's instants, after their last
    /// run.
    CoveredFacets cover() const;
    /// End state of all points.
    std::vector<HeatState::Point> left() const;

    /// Worst of all points that count: of the last run, and (worst_passes) of all runs.
    struct Summary {
        std::size_t points = 0;
        double residual = 0.0;      // [K] |P(T) − T|, of points without alternating days
        double largest_move = 0.0;  // [K] change of the next start
        std::size_t worst_facet = 0;
        std::size_t alternating = 0, alternating_facet = 0;  // no repeated day: how many, the worst
        double alternation = 0.0;                            // [K] from one day to the next
        std::size_t stores_held = 0;                         // amounts that change from day to day
        double store_growth = 0.0;                           // [mm] largest change per day of these
        double worst_closure = 0.0;
        int worst_passes = 0, limited = 0;
        int unsolved = 0;                      // steps skipped without solution
        std::size_t first_unsolved_facet = 0;  // if unsolved: the first of these, and when
        Instant first_unsolved{};
        bool fresh = false;                                   // the last pass added some
        std::size_t batched = 0, stores = 0, unfollowed = 0;  // see SolveReport
        double most_dew_unfollowed = 0.0, dew_left_out = 0.0, worst_water_closure = 0.0;
    };
    Summary summary() const;

 private:
    void take_in(const Level& level);
    struct Need {
        bool taken = false, unfollowed = false;
        double dew = 0.0, warming = 0.0;
    };
    Need need_of(const Level& level, const Block& block, std::size_t lane, bool all_dew,
                 std::vector<double>& warmest) const;
    std::vector<std::vector<Need>> all_needs(const Level& level, bool all_dew) const;
    bool by_itself(const Level& level, const FacetPoint& point) const;
    double mean_kelvin(std::size_t facet) const;  // mean over the span, of the solve
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
    std::vector<std::optional<PointColumn>> column_;  // (kind) of points in lanes
    bool rains_ = false, fresh_ = false;
    std::size_t stores_ = 0, batched_ = 0;
    Summary left_out_;  // values of facets that stay in blocks
};

}  // namespace diurna
