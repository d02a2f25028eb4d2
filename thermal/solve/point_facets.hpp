#pragma once

#include <vector>

#include "thermal/point/point_facet.hpp"
#include "thermal/solve/solve_state.hpp"

namespace diurna {

/// What a material asks of the solver beyond a linear column under a dry or evenly wet surface.
enum class PointNeed {
    never,
    if_freezing,  // ground whose water may freeze: where a facet falls below 273.15 K
    always,       // canopy, store of water, snow, regolith, schedules
};
PointNeed point_need(const ThermalSurface& surface);

/// The facets of a scene that are solved one by one as points (thermal/point/point_facet.hpp), with
/// the sun, sky and neighbours of the scene: forcing straight between step instants, jumps at
/// shadows' edges. Steps of `SolveOptions::step`, second order.
///
/// The blocks solve these facets too, as if they were plain: their first guess. A facet costs some
/// 5 ms a periodic day, five hundred times a plain one, so none is taken that needs no more.
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
    /// What the span leaves of all points.
    std::vector<HeatState::Point> left() const;

    std::size_t size() const { return point_.size(); }
    /// Worst of all points: of the last run, and (worst_passes) of all runs together.
    struct Summary {
        double residual = 0.0;      // [K] |P(T) − T|
        double largest_move = 0.0;  // [K] that the next start is away
        double worst_closure = 0.0;
        int worst_passes = 0, limited = 0;
        bool fresh = false;  // some were taken in by the last pass
    };
    Summary summary() const;

 private:
    struct Point {
        std::size_t facet, block, lane;
        bool begun = false;
        HeatState::Point start, end;
        std::vector<float> kelvin, excess;  // (instant) of the last run; what it ran under
        std::vector<float> back_kelvin{}, back_excess{};  // the same of its back, if it has one
        double residual = 0.0, move = 0.0;
        int passes = 0;
        PointFacet::Count count;
    };
    void take_in(const Level& level);
    double mean_kelvin(std::size_t facet) const;  // over the span, as it is in the solve
    void run(const Level& level, Point& point) const;
    void march_span(const std::vector<Instant>& edge, PointFacet& facet, Point& point,
                    Eigen::MatrixXd* map) const;
    bool rests(const Point& point) const;
    /// The facet that is a point's back; none: the facet itself.
    std::size_t back_of_point(const Point& point) const {
        const Block& block = solve_.block[point.block];
        return block.behind.empty() ? point.facet : block.behind[point.lane];
    }

    const SolveState& solve_;
    std::vector<Forcing> weather_;  // (instant)
    std::vector<bool> taken_;       // (facet)
    std::vector<Point> point_;
    bool fresh_ = false;
};

}  // namespace diurna
