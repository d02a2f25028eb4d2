#include "thermal/solve/solver.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>
#include <span>
#include <utility>
#include <variant>

#include "materials/base/parallel.hpp"
#include "terrain/place/sun_path.hpp"
#include "thermal/solve/extrapolation.hpp"
#include "thermal/solve/first_guess.hpp"
#include "thermal/solve/grouping.hpp"
#include "thermal/solve/handed_state.hpp"
#include "thermal/solve/heat_record.hpp"
#include "thermal/solve/incident_sunlight.hpp"
#include "thermal/solve/longwave_exchange.hpp"
#include "thermal/solve/network_facets.hpp"
#include "thermal/solve/no_solution.hpp"
#include "thermal/solve/pass.hpp"
#include "thermal/solve/periodic_newton.hpp"
#include "thermal/solve/point_facets.hpp"
#include "thermal/solve/time_level.hpp"
#include "thermal/solve/what_is_left.hpp"
#include "thermal/weather/sky_by_height.hpp"

namespace diurna {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}
/// [s] of all threads of this process, so far
double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Backs of sheets that have a room behind, or ground, are as warm as that throughout.
void put_rooms(SolveState& solve) {
    for (std::size_t f = 0; f < solve.other_side.size(); ++f) {
        if (!solve.is_back(f)) continue;
        const MaterialId front = solve.input.facets.material[solve.other_side[f]];
        const Bottom& bottom = solve.input.materials[front].thermal.bottom;
        const auto* room = std::get_if<Interior>(&bottom);
        const auto* ground = std::get_if<FixedTemperature>(&bottom);
        if (!room && !ground) continue;
        const double kelvin = room ? room->air_temperature : ground->temperature;
        solve.kelvin.fill(f, float(kelvin));
    }
}

/// The largest number of steps that divides the span and takes an hour at most.
std::size_t coarse_stride(const SolveState& solve) {
    auto stride = static_cast<std::size_t>(std::max(1.0, std::floor(3600.0 / solve.step + 1e-9)));
    while (solve.steps() % stride != 0) --stride;
    return stride;
}

/// The instants whose temperatures are stored.
std::vector<std::size_t> stored(const SolveState& solve) {
    if (solve.options.keep_at) return *solve.options.keep_at;
    const auto every = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::llround(solve.options.keep_every / solve.step)));
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < solve.instant.size(); i += every) all.push_back(i);
    return all;
}

/// The temperatures to be kept.
TemperatureField kept(const SolveState& solve, const CoveredFacets& water) {
    const std::vector<std::size_t> instants = stored(solve);
    TemperatureField field{.instant = {}, .facets = solve.facets, .kelvin = {}};
    field.water.facet = water.facet;
    field.kelvin.resize(instants.size() * solve.facets);
    solve.kelvin.decode(instants, field.kelvin);
    field.water.cover.reserve(instants.size() * water.facet.size());
    for (std::size_t row = 0; row < instants.size(); ++row) {
        const std::size_t i = instants[row];
        field.instant.push_back(solve.instant[i]);
        const auto cover = water.at(i);
        field.water.cover.insert(field.water.cover.end(), cover.begin(), cover.end());
    }
    field.water = field.water.kept();
    return field;
}

/// Adds the time it lives to a stage's seconds, and that of all threads to its processor seconds.
class Stopwatch {
 public:
    explicit Stopwatch(double& seconds, double* cpu = nullptr) : seconds_(seconds), cpu_(cpu) {}
    ~Stopwatch() {
        seconds_ += seconds_since(begun_);
        if (cpu_) *cpu_ += cpu_seconds() - cpu_begun_;
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

 private:
    double& seconds_;
    double* cpu_;
    Clock::time_point begun_ = Clock::now();
    double cpu_begun_ = cpu_seconds();
};

/// The sky at every step's instant, and the light it sends to every facet.
void set_irradiance(SolveState& solve, const HandedOver& given) {
    SunPath path(solve.input.site);
    for (const Instant when : solve.instant) {
        solve.sky.push_back(solve.series.at(when, path.at(when)));
        if (solve.tiers.flat()) continue;
        const Forcing now = solve.series.weather().at(when);
        const AirByHeight& rule = *solve.input.by_height;
        for (const double height : solve.tiers.height) {
            solve.tier_sky.push_back(sky_at_height(solve.sky.back(), now,
                                                   air_at_height(rule, now.air, height), rule,
                                                   height, solve.input.clear_sky));
        }
    }
    solve.tilt = tilts(solve);
    take_earlier_water(solve);
    store_shares(solve);
    if (given.sun != nullptr) given.sun->fraction = std::vector<float>();
    find_jumps(solve);
    if (given.sun != nullptr) given.sun->edge = std::vector<ShadowEdge>();
    add_sunlight(solve);
}

/// Recomputes the neighbours' longwave, if there are neighbours.
ExchangeChange renew_longwave(SolveState& solve, const Level& level, ExchangeRoom& room,
                              SolveReport& report) {
    check_numbers(solve);  // before neighbours take on what is none
    if (solve.excess.empty()) return {};
    const Stopwatch watch(report.exchange_seconds);
    return exchange_longwave(solve, level, room);
}

/// [K] The largest correction of a block's start after the last pass.
double largest_move(const SolveState& solve) {
    double most = 0.0;
    for (const Block& block : solve.block) {
        if (solve.of_target(block) || solve.is_beside(block)) continue;
        most = std::max(most, block.largest_move);
    }
    return most;
}

/// A day in hours, a few times, leaves a few tenths of a kelvin to the passes that count.
void pass_in_hours(SolveState& solve, const std::vector<KindOf>& kinds, std::size_t stride,
                   Level& fine, NetworkFacets& targets, ExchangeRoom& room, SolveReport& report) {
    const bool neighbours = !solve.excess.empty();
    const int passes = !neighbours ? 2 : solve.options.quick ? 3 : 4, most_passes = 10;
    constexpr double alike = 5.0;  // [W m⁻²] of what targets' neighbours send from pass to pass
    Level coarse = make_level(solve, kinds, stride, 1, &fine);
    renew_longwave(solve, coarse, room, report);
    double moved = 0.0;
    for (int i = 0; i < passes || (i < most_passes && targets.moved() > alike); ++i) {
        {
            const Stopwatch watch(report.step_seconds, &report.step_cpu_seconds);
            set_films(solve, coarse, i == 0 ? fine : coarse);
            pass(solve, coarse, 0.0, 0.0);
            renew_matrices(solve, coarse, solve.block);
            correct(solve, coarse);
            targets.pass(solve, coarse);
        }
        const double warmer = renew_longwave(solve, coarse, room, report).warmer;
        const double before = std::exchange(moved, largest_move(solve) + warmer);
        if (i > 0) solve.left_by_pass = std::clamp(moved / before, 0.05, 1.0);
    }
    solve.kelvin = filled_between(solve, solve.kelvin, stride);
    if (neighbours && !solve.excess.linear()) {
        solve.excess = filled_between(solve, solve.excess, stride);
    }
    set_films(solve, fine, coarse);
    for (Block& block : solve.block) {
        block.move.clear();
        block.residual = 1e9;
        block.slope.clear();
    }
}

/// What is left after a pass and the exchange that followed it, and whether that will do.
void judge(const SolveState& solve, const PointFacets& points, const NetworkFacets& targets,
           const ExchangeChange& change, SolveReport& report) {
    const SolveOptions& options = solve.options;
    // Corrections to first order leave a share of themselves, which passes in hours have measured.
    const double left = options.quick && options.periodic ? solve.left_by_pass : 1.0;
    report.left_by_pass = left;
    report.exchange_change = change.heat;
    report.periodic_residual = 0.0;
    report.estimated_error = left * change.warmer;
    for (const Block& block : solve.block) {
        if (!options.periodic) break;
        if (solve.of_target(block) || solve.is_beside(block)) continue;
        report.periodic_residual = std::max(report.periodic_residual, left * block.residual);
        report.estimated_error =
            std::max(report.estimated_error, left * (block.largest_move + change.warmer));
    }
    constexpr double least_film = 8.0;  // [W m⁻² K⁻¹] radiation and calm air
    report.estimated_error = std::max(report.estimated_error, report.light_change / least_film);
    const PointFacets::Summary single = points.summary();
    report.periodic_residual = std::max(report.periodic_residual, single.residual);
    report.estimated_error = std::max(report.estimated_error, single.largest_move);
    report.estimated_error = std::max(report.estimated_error, targets.summary().error);
    // Water, snow and ground freeze and thaw at some step of a facet's own. From pass to pass this
    // hour shifts, and with it what the neighbours get, by some hundredths of a kelvin.
    constexpr double own_steps = 0.05;
    report.limit = single.points > 0 ? std::max(options.settled, own_steps) : options.settled;
    // Dew that a second pass finds moves its neighbours' longwave by less than that.
    const bool unseen =
        single.fresh && !solve.excess.empty() && !(options.quick && report.passes > 1);
    report.within_error = report.estimated_error <= report.limit && !unseen &&
                          targets.at_rest(report.limit) && targets.summary().limited == 0;
    report.converged = report.within_error && report.periodic_residual <= options.tolerance;
}

/// What passes have left of a span, in what may be left.
class Nearing {
 public:
    void add(const SolveReport& report, const SolveOptions& options) {
        std::shift_right(left_.begin(), left_.end(), 1);
        left_.front() = std::max(report.periodic_residual / options.tolerance,
                                 report.estimated_error / options.settled);
    }
    /// The last four have brought it nearer by a half: what goes to and fro does so less and less.
    /// Four, as a block that rested may wake and be further than it was.
    bool nearer() const { return left_.front() < 0.5 * left_.back(); }

 private:
    std::array<double, 5> left_{1e9, 1e9, 1e9, 1e9, 1e9};  // the last first
};

/// Passes over the span at its own steps until they change nothing that counts.
void pass_until_settled(SolveState& solve, Level& level, PointFacets& points,
                        NetworkFacets& targets, ExchangeRoom& room, SolveReport& report) {
    constexpr double usual_passes = 3.0;
    const SolveOptions& options = solve.options;
    Nearing nearing;
    Extrapolation extrapolation;
    const auto goes_on = [&] {
        return report.passes < options.max_passes ||
               (report.passes < 2 * options.max_passes && nearing.nearer());
    };
    // Where passes no longer bring it nearer, the error that temperatures may have decides; a
    // column that only gathers heat has no such estimate, but its residual stays.
    const auto within = [&] {
        return report.within_error && report.periodic_residual <= options.settled;
    };
    constexpr int many_passes = 6;
    while (!report.converged && goes_on()) {
        if (report.passes > many_passes && within() && !nearing.nearer()) break;
        {
            const Stopwatch watch(report.step_seconds, &report.step_cpu_seconds);
            const double done = std::min(0.95, report.passes / usual_passes);
            pass(solve, level, done, std::min(1.0, done + 1.0 / usual_passes));
            ++report.passes;
            if (options.periodic && report.passes == 1) renew_matrices(solve, level, solve.block);
            if (options.periodic) correct(solve, level);
            points.pass(solve, level);
            targets.pass(solve, level);
        }
        {
            const Stopwatch watch(report.exchange_seconds);
            report.light_change = relight(solve, points.cover());
        }
        // What the neighbours send by now reports how far the pass was from its surroundings.
        judge(solve, points, targets, renew_longwave(solve, level, room, report), report);
        nearing.add(report, options);
        if (!report.converged) extrapolation.after_pass(solve);
        if (options.tell && !report.converged) {
            options.tell(what_is_left(solve, points, targets, report));
        }
    }
    report.converged = within();
    points.put(solve);
    targets.put(solve);
}

/// What all steps of the last pass left behind.
void tell_steps(const SolveState& solve, const PointFacets& points, const NetworkFacets& targets,
                SolveReport& report) {
    StepRecord record;
    for (const Block& block : solve.block) {
        if (!solve.is_beside(block)) record.merge(block.record);
    }
    const PointFacets::Summary single = points.summary();
    report.points = single.points;
    report.point_passes = single.worst_passes;
    report.limited = single.limited;
    report.batched = single.batched;
    report.stores = single.stores;
    report.unfollowed = single.unfollowed;
    report.most_dew_unfollowed = single.most_dew_unfollowed;
    report.dew_left_out = single.dew_left_out;
    report.worst_water_closure = single.worst_water_closure;
    report.stores_held = single.stores_held;
    report.store_growth = single.store_growth;
    report.alternating = single.alternating;
    report.alternation = single.alternation;
    if (single.alternating > 0)
        report.alternating_facet = facet_name(solve, single.alternating_facet);
    report.furthest = furthest_facets(solve, points, targets);
    const NetworkFacets::Summary network = targets.summary();
    report.target_facets = network.facets;
    if (solve.options.periodic) report.target_residual = network.residual;
    report.limited += network.limited;
    check_numbers(solve);
    report.unsolved = without_solution(solve, single, network);
    report.converged = report.converged && report.unsolved.empty();
    report.worst_energy_closure = std::max({record.worst_closure, single.worst_closure,
                                            solve.options.leads_in ? 0.0 : network.worst_closure});
    report.newton_iterations = double(record.iterations) / double(std::max(1LL, record.stages));
    report.worst_newton_iterations = record.worst_iterations;
    report.bisections = record.bisections;
    const PackedField::Extremes all = solve.kelvin.extremes(solve.counted);
    report.coldest = all.least;
    report.warmest = all.greatest;
}

/// Once more over the span, every facet, as it has settled: what the balance is made of.
HeatFluxField record_heat(SolveState& solve, const Level& level, PointFacets& points,
                          NetworkFacets& targets) {
    if (solve.options.heat_at.empty()) return {};
    HeatRecord record(solve, solve.options.heat_at);
    solve.record = &record;
    pass(solve, level, 1.0, 1.0);
    points.pass(solve, level);
    targets.pass(solve, level);
    solve.record = nullptr;
    return record.field();
}

}  // namespace

SolveResult solve(const SolveInput& input, const SolveOptions& options, HandedOver given) {
    const auto begun = Clock::now();
    check(input, options);
    const SkySeries series(input.weather, input.site, input.elevation, input.clear_sky,
                           options.start, later(options.start, options.duration));
    SolveState state(input, options, series);
    SolveReport report{
        .facets = state.facets, .steps = int(state.steps()), .limit = options.settled};
    const std::vector<KindOf> kinds = group_by_material(state);
    set_irradiance(state, given);
    Level fine = make_level(state, kinds, 1, StepSetup{}.most_substeps);
    const std::size_t hours = coarse_stride(state);
    const std::size_t stride = options.periodic && !input.from ? hours : 1;  // of the first passes
    state.kelvin = PackedField::of_steps(state.instant.size(), stride, state.facets);
    put_rooms(state);
    settle(state, fine);
    bool near = false;
    if (input.from) {
        near = set_out_from(*input.from, std::move(given.guess), state);
        if (given.from != nullptr) {
            given.from->block = std::vector<std::vector<double>>();
            given.from->of_block = std::vector<std::vector<std::size_t>>();
        }
    } else {
        check_mean_balance(state);
    }
    if (options.exchange && exchanging(input)) {
        state.excess = options.quick
                           ? PackedField::linear_between(state.instant.size(), hours, state.facets)
                           : PackedField::of_steps(state.instant.size(), stride, state.facets);
    }
    ExchangeRoom room;
    NetworkFacets targets(state, near);
    if (input.from) targets.set_out_from(input.from->network);
    if (stride > 1) {
        pass_in_hours(state, kinds, stride, fine, targets, room, report);
    } else {
        renew_longwave(state, fine, room, report);
    }
    PointFacets points(state);
    // A first guess does without: points find their own start from the blocks'.
    if (input.from && !options.periodic) points.set_out_from(input.from->point);
    pass_until_settled(state, fine, points, targets, room, report);
    room = {};
    state.shares = {};
    HeatFluxField heat = record_heat(state, fine, points, targets);
    points.measure_left_out(fine);
    tell_steps(state, points, targets, report);
    HeatState end = left_by(state, fine, points, targets);
    SolveResult result{.temperature = kept(state, points.cover()),
                       .report = report,
                       .end = std::move(end),
                       .heat = std::move(heat),
                       .steps = std::move(state.kelvin)};
    result.report.seconds = seconds_since(begun);
    if (options.progress) options.progress(1.0);
    return result;
}

}  // namespace diurna
