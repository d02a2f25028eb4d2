#include "thermal/solve/point_group.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>

#include "materials/base/units.hpp"
#include "thermal/solve/block_profile.hpp"
#include "thermal/solve/facet_forcing.hpp"
#include "thermal/solve/heat_record.hpp"
#include "thermal/steppers/enthalpy_batch.hpp"

namespace diurna {

namespace {

constexpr std::size_t W = enthalpy_lanes;
constexpr double slice_height = 8.0;  // [m]: 26 mK of air from its middle to its ends

/// The slowest deviations of a thawed column under a usual film: C⁻¹ K's, orthonormal in C.
void find_slow(double duration, PointColumn& point) {
    constexpr double film = 10.0;    // [W m⁻² K⁻¹]
    constexpr double decayed = 2.5;  // a deviation that falls by e^−2.5 in the span needs no Newton
    constexpr Eigen::Index most = 12;
    const EnthalpyColumn& c = point.plain;
    const auto n = static_cast<Eigen::Index>(c.node.size());
    if (std::any_of(c.node.begin(), c.node.end(),
                    [](const EnthalpyNode& node) { return node.latent > 0.0 && !node.drains; })) {
        // Water that is half frozen keeps what it is given: nothing is sure to be quick.
        point.slow = point.weight = Eigen::MatrixXd::Identity(n, n);
        return;
    }
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n);
    Eigen::VectorXd root(n);
    for (Eigen::Index i = 0; i < n; ++i) root[i] = std::sqrt(c.node[std::size_t(i)].thawed);
    for (Eigen::Index i = 0; i + 1 < n; ++i) {
        const EnthalpyLink& link = c.link[std::size_t(i)];
        const double g = link.per_width * link.thawed;
        k(i, i) += g;
        k(i + 1, i + 1) += g;
        k(i, i + 1) -= g;
        k(i + 1, i) -= g;
    }
    k(0, 0) += film;
    k(n - 1, n - 1) +=
        c.below_is_link ? c.below_link.per_width * c.below_link.thawed : c.below_conductance;
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index j = 0; j < n; ++j) k(i, j) /= root[i] * root[j];
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(k);
    Eigen::Index count = 1;
    while (count < std::min(n, most) && modes.eigenvalues()[count] * duration < decayed) ++count;
    point.slow = modes.eigenvectors().leftCols(count).array().colwise() / root.array();
    point.weight = modes.eigenvectors().leftCols(count).array().colwise() * root.array();
}

/// A group on its way.
class GroupRun {
 public:
    GroupRun(const SolveState& solve, const Level& level, const PointColumn& column,
             const std::vector<Forcing>& weather, std::span<FacetPoint* const> point)
        : solve_(solve),
          kind_(level.kind[solve.block[point[0]->block].material]),
          column_(column),
          point_(point) {
        prepare_batch();
        prepare_air(weather);
        for (std::size_t l = 0; l < point.size(); ++l) prepare_lane(l);
        for (std::size_t l = point.size(); l < W; ++l) copy_lane(0, l);
        for (std::size_t i = 0; i + 1 < solve.instant.size(); ++i) find_edges_of(i);
    }

    void run() {
        constexpr int most_passes = 8;          // at a time: neighbours change in between
        constexpr double settled_water = 1e-3;  // [mm]
        const bool periodic = solve_.options.periodic;
        std::array<double, W> before;
        std::array<bool, W> plain{};
        before.fill(1e9);
        for (int pass = 0; pass < most_passes; ++pass) {
            const std::vector<double> start = batch_.u;
            const auto stood = batch_.standing;
            batch_.columns = periodic && carries_ ? std::size_t(column_.slow.cols()) : 0;
            set_out();
            march_span();
            bool settled = true, carries = false;
            for (std::size_t l = 0; l < point_.size(); ++l) {
                FacetPoint& p = *point_[l];
                finish_pass(l, stood[l]);
                if (!periodic) continue;
                const double last = before[l];
                close_period(start, l, before[l], plain[l]);
                // A map that serves well need not be carried again.
                carries = carries || plain[l] || p.residual > 0.2 * last;
                settled = settled && p.residual <= solve_.options.tolerance && p.move <= 0.01 &&
                          apart(batch_.standing[l], stood[l]) <= settled_water;
            }
            if (!periodic) return;
            for (std::size_t l = point_.size(); l < W; ++l) copy_lane(0, l);
            carries_ = carries;
            if (settled) break;
        }
        for (std::size_t l = 0; l < point_.size(); ++l) {
            FacetPoint& p = *point_[l];
            for (std::size_t i = 0; i < nodes(); ++i) p.start.u[i] = batch_.u[i * W + l];
            p.start.standing = batch_.standing[l];
        }
    }

 private:
    std::size_t nodes() const { return column_.plain.node.size(); }

    void prepare_batch() {
        batch_.surface = &kind_.column.surface;
        batch_.column = &column_.plain;
        batch_.count = point_.size();
        batch_.u.resize(nodes() * W);
    }
    /// Air and its film at the instants, at the middle of the slice.
    void prepare_air(const std::vector<Forcing>& weather) {
        const double height = slice_height * (double(height_slice(solve_, point_[0]->facet)) + 0.5);
        const bool in_lee = std::any_of(point_.begin(), point_.end(), [&](const FacetPoint* p) {
            return solve_.block[p->block].sheltered;
        });
        for (const Forcing& now : weather) {
            const AirState air = solve_.tiers.flat()
                                     ? now.air
                                     : air_at_height(*solve_.input.by_height, now.air, height);
            air_.push_back(air_film(kind_.column.surface, kind_.column.louis, air, now.wind_speed));
            if (in_lee) air_.back().kind = FilmKind::sheltered_ground;
            rain_.push_back(std::max(0.0, now.rain_mm_h));
        }
    }
    void prepare_lane(std::size_t l) {
        FacetPoint& p = *point_[l];
        const Block& block = solve_.block[p.block];
        forcing_[l] = std::make_unique<FacetForcing>(solve_, std::vector<Forcing>(), block, p.lane);
        note_excess(solve_, p, forcing_[l]->has_other_side());
        if (forcing_[l]->has_other_side()) p.back_kelvin.resize(solve_.instant.size());
        p.kelvin.resize(solve_.instant.size());
        const double up = solve_.input.facets.normal[p.facet].z();
        batch_.natural[l] =
            facet_film(kind_.column.surface.convection, up, solve_.part_of(p.facet));
        batch_.capacity[l] = store_capacity(kind_.column.surface.store, up);
        batch_.rain_share[l] = forcing_[l]->rain();
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
    }
    void copy_lane(std::size_t from, std::size_t to) {
        for (std::size_t i = 0; i < nodes(); ++i) batch_.u[i * W + to] = batch_.u[i * W + from];
        batch_.standing[to] = batch_.standing[from];
        batch_.natural[to] = batch_.natural[from];
        batch_.capacity[to] = batch_.capacity[from];
        batch_.rain_share[to] = batch_.rain_share[from];
    }
    const FacetForcing& forcing(std::size_t l) const {
        return *forcing_[l < point_.size() ? l : 0];
    }
    /// Where sunlight jumps on any lane in step i, as shares of it.
    void find_edges_of(std::size_t i) {
        first_edge_.push_back(edge_.size());
        const std::size_t from = edge_.size();
        for (std::size_t l = 0; l < point_.size(); ++l) {
            for (const Instant when : forcing_[l]->edges()) {
                const double share = seconds_between(solve_.instant[i], when) / solve_.step;
                if (share >= 0.0 && share < 1.0) edge_.push_back(share);
            }
        }
        std::sort(edge_.begin() + std::ptrdiff_t(from), edge_.end());
        if (i + 2 == solve_.instant.size()) first_edge_.push_back(edge_.size());
    }

    void set_out() {
        batch_.rates = {};
        for (std::size_t l = 0; l < W; ++l) {
            batch_.snow_albedo[l] = point_[l < point_.size() ? l : 0]->start.snow_albedo;
        }
        batch_.water = {};
        batch_.worst_closure = 0.0;
        batch_.map.resize(nodes() * batch_.columns * W);
        batch_.steps = 0;
        limited_ = 0;
        for (std::size_t i = 0; i < nodes(); ++i) {
            for (std::size_t k = 0; k < batch_.columns; ++k) {
                for (std::size_t l = 0; l < W; ++l) {
                    batch_.map[(i * batch_.columns + k) * W + l] =
                        column_.slow(Eigen::Index(i), Eigen::Index(k));
                }
            }
        }
    }

    /// From a share of step i to another.
    EnthalpyForcing forcing_over(std::size_t i, double from, double to) const {
        EnthalpyForcing f{.duration = (to - from) * solve_.step};
        const double middle = 0.5 * (from + to);
        f.rain_mm_h = std::lerp(rain_[i], rain_[i + 1], middle);
        f.air_temperature = std::lerp(air_[i].air_temperature, air_[i + 1].air_temperature, middle);
        f.has_back = forcing(0).has_back();
        for (std::size_t k = 0; k < 2; ++k) {
            const double at = from + stage_share[k] * (to - from);
            f.air[k] = air_between(air_[i], air_[i + 1], at);
            f.measured_albedo[k] =
                std::lerp(measured_albedo(solve_.sky[i], kind_.measured_share),
                          measured_albedo(solve_.sky[i + 1], kind_.measured_share), at);
            for (std::size_t l = 0; l < W; ++l) {
                f.sunlight[k][l] = forcing(l).sunlight(i, at);
                f.longwave[k][l] = forcing(l).longwave(i, at);
                if (f.has_back) f.behind[k][l] = forcing(l).behind(i, at);
            }
        }
        return f;
    }
    void step(std::size_t i, double from, double to, int depth) {
        constexpr int deepest = 10;
        EnthalpyForcing f = forcing_over(i, from, to);
        f.gentle = depth == deepest;
        if (f.gentle) ++limited_;
        if (advance(f, batch_) || f.gentle) {
            last_ = f;
            return;
        }
        const double middle = 0.5 * (from + to);
        step(i, from, middle, depth + 1);
        step(i, middle, to, depth + 1);
    }
    /// Steps that grow from 10 s after a jump.
    void march(std::size_t i, double from, double to, bool restart) {
        constexpr double first = 5.0, growth = 1.6, longest_wet = 600.0;  // [s]
        double longest = solve_.step / solve_.options.refinement;
        if (batch_.stores()) longest = std::min(longest, longest_wet);
        if (restart) next_ = first;
        while ((to - from) * solve_.step > 1e-6) {
            double share = std::min(next_, longest) / solve_.step;
            if (to - from < 1.5 * share) share = to - from;
            step(i, from, from + share, 0);
            from += share;
            next_ = std::min(growth * share * solve_.step, longest);
        }
    }
    void march_span() {
        const EnthalpyForcing first = forcing_over(0, 0.0, 0.0);
        for (std::size_t l = 0; l < W; ++l) {
            batch_.skin[l] = column_.column.temperature(0, batch_.u[l]);
        }
        take_down(0, first, true);
        bool restart = true;
        for (std::size_t i = 0; i + 1 < solve_.instant.size(); ++i) {
            double now = 0.0;
            for (std::size_t k = first_edge_[i]; k < first_edge_[i + 1]; ++k) {
                if ((edge_[k] - now) * solve_.step < 1.0 && now > 0.0) continue;
                march(i, now, edge_[k], restart);
                now = edge_[k];
                restart = true;
            }
            march(i, now, 1.0, restart);
            restart = false;
            take_down(i + 1, last_, false);
        }
    }
    void take_down(std::size_t i, const EnthalpyForcing& f, bool now) {
        const std::size_t last = nodes() - 1;
        const bool wanted = solve_.record && solve_.record->wants(i);
        for (std::size_t l = 0; l < point_.size(); ++l) {
            FacetPoint& p = *point_[l];
            const double ground = column_.column.temperature(0, batch_.u[l]);
            p.kelvin[i] = float(batch_.skin[l]);
            if (!p.back_kelvin.empty()) {
                p.back_kelvin[i] = float(column_.column.temperature(last, batch_.u[last * W + l]));
            }
            if (!wanted && !now) continue;
            const SurfaceTerms terms = surface_terms(conditions_of(batch_, f, l, now), ground);
            if (now) p.kelvin[i] = float(terms.radiometric);
            if (!wanted) continue;
            HeatBalance balance = terms.balance;
            balance.conducted = now ? -terms.into_ground : -batch_.taken[l];
            solve_.record->put(i, p.facet, balance, -terms.frost_melt);
            if (p.back_kelvin.empty()) continue;
            record_point_back(solve_, kind_, solve_.block[p.block], p.lane, i,
                              forcing_[l]->behind(i == 0 ? 0 : i - 1, i == 0 ? 0.0 : 1.0),
                              double(p.back_kelvin[i]));
        }
    }

    void finish_pass(std::size_t l, const Standing& stood) {
        FacetPoint& p = *point_[l];
        ++p.passes;
        p.count = {.steps = batch_.steps,
                   .rejected = 0,
                   .limited = limited_,
                   .worst_closure = batch_.worst_closure};
        p.water_closure = std::abs(batch_.water[l].open(stood, batch_.standing[l]));
        p.end = {p.facet, std::vector<double>(nodes()), batch_.standing[l], batch_.snow_albedo[l]};
        for (std::size_t i = 0; i < nodes(); ++i) p.end.u[i] = batch_.u[i * W + l];
    }
    /// Newton's move of a lane's start, put in place of its end.
    void close_period(const std::vector<double>& start, std::size_t l, double& before,
                      bool& plain) {
        FacetPoint& p = *point_[l];
        const auto n = static_cast<Eigen::Index>(nodes());
        const Eigen::Index m = column_.slow.cols();
        Eigen::VectorXd change(n);
        Eigen::MatrixXd& map = map_[l];
        if (carries_) map.resize(n, m);
        for (Eigen::Index i = 0; i < n; ++i) {
            const auto at = std::size_t(i) * W + l;
            change[i] = batch_.u[at] - start[at];
            for (Eigen::Index k = 0; carries_ && k < m; ++k) {
                map(i, k) = batch_.map[(std::size_t(i) * batch_.columns + std::size_t(k)) * W + l];
            }
        }
        p.residual = change.cwiseAbs().maxCoeff();
        // Where a front of freezing passes other nodes than it did, the map before misleads.
        plain = !plain && p.residual > 0.5 * before && !column_.column.linear();
        before = p.residual;
        p.move = p.residual;
        if (plain) return;
        const Eigen::VectorXd slow = column_.weight.transpose() * change;
        const Eigen::MatrixXd left =
            Eigen::MatrixXd::Identity(m, m) - column_.weight.transpose() * map;
        Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> period;
        period.setThreshold(1e-9);  // a column that loses nothing keeps its mean
        period.compute(left);
        const Eigen::VectorXd move = change + column_.slow * (period.solve(slow) - slow);
        // What no start explains goes on for days.
        const Eigen::VectorXd drift = change - move + map * (column_.weight.transpose() * move);
        const double through = days_to_melt(start, drift, l);
        constexpr double farthest = 20.0;
        for (Eigen::Index i = 0; i < n; ++i) {
            const std::size_t node = std::size_t(i);
            const double from = start[node * W + l];
            const double most = column_.column.linear() ? 1e4 : farthest;
            double to = from + std::clamp(move[i] + through * drift[i], -most, most);
            to = column_.column.up_to_kink(node, from, to);
            const double t = column_.column.temperature(node, to);
            if (t < 1.0 || t > 5000.0) {
                to = column_.column.state_of(node, std::clamp(t, 1.0, 5000.0));
            }
            batch_.u[node * W + l] = to;
        }
        p.move = move.cwiseAbs().maxCoeff();
    }
    /// A node that lies at the melting point all day freezes or melts by the same each day: how
    /// many days until the fastest is through.
    double days_to_melt(const std::vector<double>& start, const Eigen::VectorXd& drift,
                        std::size_t l) const {
        double fastest = 1e-5, days = 0.0;  // of a node's water a day
        for (std::size_t i = 0; i < nodes(); ++i) {
            const double by = drift[Eigen::Index(i)], from = start[i * W + l];
            if (!column_.column.melts(i) || from < 0.0 || from > 1.0) continue;
            if (std::abs(by) < fastest) continue;
            fastest = std::abs(by);
            days = (by > 0.0 ? 1.0 - from : from) / fastest + 0.01;
        }
        return days;
    }

    const SolveState& solve_;
    const Kind& kind_;
    const PointColumn& column_;
    std::span<FacetPoint* const> point_;
    EnthalpyBatch batch_;
    std::array<std::unique_ptr<FacetForcing>, W> forcing_;
    std::vector<AirFilm> air_;  // (instant)
    std::vector<double> rain_;  // (instant) [mm/h]
    std::vector<double> edge_;
    std::vector<std::size_t> first_edge_;  // (step)
    EnthalpyForcing last_;
    std::array<Eigen::MatrixXd, W> map_;  // [lane] of the last pass that carried it
    bool carries_ = true;
    double next_ = 10.0;  // [s]
    int limited_ = 0;
};

}  // namespace

PointColumn point_column(const SolveState& solve, const MaterialColumn& material) {
    const ThermalSurface& surface = material.surface;
    // Behind a plate stands air; the grid then ends free.
    const Bottom bottom = surface.back ? Bottom{FixedFlux{0.0}} : surface.bottom;
    PointColumn point{.column = NonlinearColumn(surface.layers, bottom, material.reference,
                                                grid_of_point(surface, solve.options.grid)),
                      .plain = {},
                      .slow = {},
                      .weight = {}};
    point.plain = point.column.enthalpy();
    if (solve.options.periodic) find_slow(solve.options.duration, point);
    return point;
}

bool in_lanes(const ThermalSurface& surface) {
    const auto* room = std::get_if<Interior>(&surface.bottom);
    const bool schedules = !surface.internal_schedule.empty() || (room && !room->schedule.empty());
    return !schedules && std::holds_alternative<std::monostate>(surface.canopy) &&
           std::none_of(surface.layers.begin(), surface.layers.end(), [](const Layer& layer) {
               return std::holds_alternative<Radiating>(layer.law);
           });
}

long height_slice(const SolveState& solve, std::size_t facet) {
    if (solve.tiers.flat()) return 0;
    return std::lround(std::floor(double(solve.input.height[facet]) / slice_height));
}

void run_point_group(const SolveState& solve, const Level& level, const PointColumn& column,
                     const std::vector<Forcing>& weather, std::span<FacetPoint* const> point) {
    GroupRun(solve, level, column, weather, point).run();
}

}  // namespace diurna
