#include "thermal/solve/point_group.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "thermal/solve/block_profile.hpp"
#include "thermal/solve/facet_forcing.hpp"
#include "thermal/solve/heat_record.hpp"
#include "thermal/solve/lane_clock.hpp"
#include "thermal/solve/period_search.hpp"
#include "thermal/solve/point_air.hpp"
#include "thermal/steppers/enthalpy_batch.hpp"
#include "thermal/surface/canopy.hpp"

namespace diurna {

namespace {

constexpr std::size_t W = enthalpy_lanes;

/// A point in progress.
struct Lane {
    FacetPoint* point = nullptr;  // null: idle
    std::unique_ptr<FacetForcing> forcing{};
    std::optional<LaneClock> clock{};
    const std::vector<AirFilm>* air = nullptr;  // (instant)
    Eigen::VectorXd start{};                    // of the pass
    Standing stood{};
    PeriodSearch search{};
    int passes = 0, limited = 0, unsolved = 0;
    std::size_t first_unsolved = 0;  // the step
    long long steps = 0;             // of the pass
};

/// A group in progress.
class GroupRun {
 public:
    GroupRun(const SolveState& solve, const Level& level, const PointColumn& column,
             const std::vector<Forcing>& weather, std::span<FacetPoint* const> point)
        : solve_(solve),
          kind_(level.kind[solve.block[point[0]->block].material]),
          column_(column),
          waiting_(point),
          air_(solve, kind_, weather, solve.block[point[0]->block].sheltered) {
        batch_.surface = &kind_.column.surface;
        batch_.column = &column_.plain;
        batch_.u.resize(nodes() * W);
        batch_.columns = solve_.options.periodic ? std::size_t(column_.slow.cols()) : 0;
        batch_.map.resize(nodes() * batch_.columns * W);
        for (const Forcing& now : weather) rain_.push_back(std::max(0.0, now.rain_mm_h));
        batch_.fullest = fullest_share(air_.over(point[0]->facet)[0]);  // as rough everywhere
        for (std::size_t l = 0; l < W; ++l) load(l);
    }

    void run() {
        for (;;) {
            std::size_t used = 0;
            while (used < W && !lane_[used].point) ++used;
            if (used == W) return;
            for (std::size_t l = 0; l < W; ++l) {
                const Lane& lane = lane_[l].point ? lane_[l] : lane_[used];
                tell_forcing(l, lane, lane.clock->from(), lane.clock->to());
            }
            const LaneMask solved = advance(forcing_, batch_);
            for (std::size_t l = 0; l < W; ++l) {
                if (lane_[l].point) go_on(l, solved[l]);
            }
        }
    }

 private:
    std::size_t nodes() const { return column_.plain.node.size(); }

    /// The next point into a lane; where none waits, what the lane holds goes on unseen.
    void load(std::size_t l) {
        Lane& lane = lane_[l];
        lane = {};
        if (next_ == waiting_.size()) {
            if (next_ < W) copy_lane(0, l);
            return;
        }
        FacetPoint& p = *waiting_[next_++];
        const Block& block = solve_.block[p.block];
        lane.point = &p;
        lane.forcing =
            std::make_unique<FacetForcing>(solve_, std::vector<Forcing>(), block, p.lane);
        lane.air = &air_.over(p.facet);
        forcing_.has_back = lane.forcing->has_back();
        const bool other_side = lane.forcing->has_other_side();
        note_excess(solve_, p, other_side);
        if (other_side) p.back_kelvin.resize(solve_.instant.size());
        p.kelvin.resize(solve_.instant.size());
        if (holds_water(kind_.column.surface)) p.cover.resize(solve_.instant.size());
        const double up = solve_.input.facets.normal[p.facet].z();
        batch_.natural[l] =
            facet_film(kind_.column.surface.convection, up, solve_.part_of(p.facet));
        batch_.capacity[l] = store_capacity(kind_.column.surface.store, up);
        batch_.rain_share[l] = lane.forcing->rain();
        if (!p.begun) {
            const DepthProfile profile = profile_at_start(kind_, block, p.lane);
            p.start.u.resize(nodes());
            for (std::size_t i = 0; i < nodes(); ++i) {
                p.start.u[i] = column_.column.state_of(i, profile.at(column_.column.depth(i)));
            }
            p.begun = true;
        }
        for (std::size_t i = 0; i < nodes(); ++i) batch_.u[i * W + l] = p.start.u[i];
        batch_.standing[l] = p.start.standing;
        set_clock(lane);
        begin_pass(l);
    }
    void set_clock(Lane& lane) const {
        constexpr double longest_wet = 600.0, first = 5.0, quick_first = 20.0;  // [s]
        std::vector<LaneClock::Jump> jumps;
        for (const Instant when : lane.forcing->edges()) {
            const double place = seconds_between(solve_.instant.front(), when) / solve_.step;
            const auto i = static_cast<std::size_t>(std::max(0.0, place));
            if (i >= solve_.steps()) continue;
            jumps.push_back({i, seconds_between(solve_.instant[i], when) / solve_.step});
        }
        double longest = solve_.step / solve_.options.refinement;
        if (batch_.stores()) longest = std::min(longest, longest_wet);
        lane.clock.emplace(solve_.steps(), solve_.step, longest,
                           solve_.options.quick ? quick_first : first, std::move(jumps));
    }
    void copy_lane(std::size_t from, std::size_t to) {
        for (std::size_t i = 0; i < nodes(); ++i) batch_.u[i * W + to] = batch_.u[i * W + from];
        batch_.standing[to] = batch_.standing[from];
        batch_.natural[to] = batch_.natural[from];
        batch_.capacity[to] = batch_.capacity[from];
        batch_.rain_share[to] = batch_.rain_share[from];
        batch_.snow_albedo[to] = batch_.snow_albedo[from];
        batch_.skin[to] = batch_.skin[from];
    }

    void begin_pass(std::size_t l) {
        Lane& lane = lane_[l];
        lane.start.resize(Eigen::Index(nodes()));
        for (std::size_t i = 0; i < nodes(); ++i) {
            lane.start[Eigen::Index(i)] = batch_.u[i * W + l];
        }
        lane.stood = batch_.standing[l];
        lane.steps = lane.limited = lane.unsolved = 0;
        batch_.rates[l] = {};
        batch_.water[l] = {};
        batch_.worst_closure[l] = 0.0;
        batch_.snow_albedo[l] = lane.point->start.snow_albedo;
        batch_.skin[l] = column_.column.temperature(0, batch_.u[l]);
        for (std::size_t i = 0; i < nodes(); ++i) {
            for (std::size_t k = 0; k < batch_.columns; ++k) {
                batch_.map[(i * batch_.columns + k) * W + l] =
                    float(column_.slow(Eigen::Index(i), Eigen::Index(k)));
            }
        }
        lane.clock->begin();
        tell_forcing(l, lane, 0.0, 0.0);
        take_down(l, 0, true);
    }

    /// What a lane meets from a share of its step to another.
    void tell_forcing(std::size_t l, const Lane& lane, double from, double to) {
        const std::size_t i = lane.clock->step();
        const AirFilm &before = (*lane.air)[i], &after = (*lane.air)[i + 1];
        EnthalpyForcing& f = forcing_;
        const double middle = 0.5 * (from + to);
        f.duration[l] = (to - from) * solve_.step;
        f.gentle[l] = lane.clock->gentle();
        f.rain_mm_h[l] = std::lerp(rain_[i], rain_[i + 1], middle);
        f.air_temperature[l] = std::lerp(before.air_temperature, after.air_temperature, middle);
        const double white = measured_albedo(solve_.sky[i], kind_.measured_share);
        const double later_white = measured_albedo(solve_.sky[i + 1], kind_.measured_share);
        for (std::size_t k = 0; k < 2; ++k) {
            const double at = from + stage_share[k] * (to - from);
            f.air[k].put(l, air_between(before, after, at));
            f.measured_albedo[k][l] = std::lerp(white, later_white, at);
            f.sunlight[k][l] = lane.forcing->sunlight(i, at);
            f.longwave[k][l] = lane.forcing->longwave(i, at);
            if (f.has_back) f.behind[k][l] = lane.forcing->behind(i, at);
        }
    }
    void go_on(std::size_t l, bool solved) {
        Lane& lane = lane_[l];
        if (!solved && !lane.clock->gentle()) {
            lane.clock->halve();
            return;
        }
        ++lane.steps;
        if (lane.clock->gentle()) ++lane.limited;
        if (!solved && lane.unsolved++ == 0) lane.first_unsolved = lane.clock->step();
        if (!lane.clock->go_on()) return;
        take_down(l, lane.clock->step(), false);
        if (lane.clock->at_end()) end_pass(l);
    }
    void take_down(std::size_t l, std::size_t i, bool now) {
        const std::size_t last = nodes() - 1;
        FacetPoint& p = *lane_[l].point;
        const double ground = column_.column.temperature(0, batch_.u[l]);
        p.kelvin[i] = float(batch_.skin[l]);
        if (!p.cover.empty()) {
            p.cover[i] = surface_cover(*batch_.surface, batch_.capacity[l], batch_.standing[l],
                                       batch_.snow_albedo[l]);
        }
        if (!p.back_kelvin.empty()) {
            p.back_kelvin[i] = float(column_.column.temperature(last, batch_.u[last * W + l]));
        }
        const bool wanted = solve_.record && solve_.record->wants(i);
        if (!wanted && !now) return;
        const SurfaceTerms terms = surface_terms(conditions_of(batch_, forcing_, l, now), ground);
        if (now) p.kelvin[i] = float(terms.radiometric);
        if (!wanted) return;
        HeatBalance balance = terms.balance;
        balance.conducted = now ? -terms.into_ground : -batch_.taken[l];
        solve_.record->put(i, p.facet, balance, -terms.frost_melt);
        if (p.back_kelvin.empty()) return;
        record_point_back(solve_, kind_, solve_.block[p.block], p.lane, i,
                          lane_[l].forcing->behind(i == 0 ? 0 : i - 1, i == 0 ? 0.0 : 1.0),
                          double(p.back_kelvin[i]));
    }

    void end_pass(std::size_t l) {
        constexpr int most_passes = 8;  // at a time: neighbours change in between
        Lane& lane = lane_[l];
        tell_pass(l);
        ++lane.passes;
        if (!solve_.options.periodic) {  // a span that does not repeat begins where it began
            load(l);
            return;
        }
        const bool closed = close_period(l);
        FacetPoint& p = *lane.point;
        if (closed || lane.passes == most_passes) {
            if (!closed) note_alternating(p);
            for (std::size_t i = 0; i < nodes(); ++i) p.start.u[i] = batch_.u[i * W + l];
            p.start.standing = batch_.standing[l];
            load(l);
        } else {
            begin_pass(l);
        }
    }
    void tell_pass(std::size_t l) {
        const Lane& lane = lane_[l];
        FacetPoint& p = *lane.point;
        ++p.passes;
        p.count = {.steps = lane.steps,
                   .rejected = 0,
                   .limited = lane.limited,
                   .unsolved = lane.unsolved,
                   .first_unsolved = solve_.instant[lane.first_unsolved],
                   .worst_closure = batch_.worst_closure[l]};
        p.water_closure = std::abs(batch_.water[l].open(lane.stood, batch_.standing[l]));
        p.end = {p.facet, std::vector<double>(nodes()), batch_.standing[l], batch_.snow_albedo[l]};
        for (std::size_t i = 0; i < nodes(); ++i) p.end.u[i] = batch_.u[i * W + l];
    }
    /// The next start in place of the end; whether the two are as good as one.
    bool close_period(std::size_t l) {
        Lane& lane = lane_[l];
        FacetPoint& p = *lane.point;
        const auto n = static_cast<Eigen::Index>(nodes());
        const auto columns = static_cast<Eigen::Index>(batch_.columns);
        Eigen::VectorXd end(n);
        Eigen::MatrixXd map(n, columns);
        for (Eigen::Index i = 0; i < n; ++i) {
            end[i] = batch_.u[std::size_t(i) * W + l];
            for (Eigen::Index k = 0; k < columns; ++k) {
                map(i, k) = double(batch_.map[std::size_t(i * columns + k) * W + l]);
            }
        }
        Eigen::VectorXd next = next_start(column_, lane.start, end, map, lane.search);
        if (p.alternates) {
            next = 0.5 * (lane.start + end);
            lane.search.move = lane.search.residual;
        }
        for (Eigen::Index i = 0; i < n; ++i) batch_.u[std::size_t(i) * W + l] = next[i];
        p.residual = lane.search.residual;
        p.move = lane.search.move;
        const bool store_settled = p.store.next(p.passes, lane.stood, batch_.standing[l]);
        return p.residual <= solve_.options.tolerance && p.move <= move_of_point(solve_.options) &&
               store_settled;
    }

    const SolveState& solve_;
    const Kind& kind_;
    const PointColumn& column_;
    std::span<FacetPoint* const> waiting_;
    std::size_t next_ = 0;  // of those that wait
    PointAir air_;
    std::vector<double> rain_{};  // (instant) [mm/h]
    EnthalpyBatch batch_;
    EnthalpyForcing forcing_;
    std::array<Lane, W> lane_;
};

}  // namespace

void run_point_group(const SolveState& solve, const Level& level, const PointColumn& column,
                     const std::vector<Forcing>& weather, std::span<FacetPoint* const> point) {
    GroupRun(solve, level, column, weather, point).run();
}

}  // namespace diurna
