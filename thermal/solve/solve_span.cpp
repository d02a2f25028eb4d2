#include "thermal/solve/solve_span.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "terrain/place/sun.hpp"
#include "thermal/weather/repeated_day.hpp"

namespace diurna {

int days_known_before(const Weather& weather, Instant when) {
    const double known = seconds_between(weather.instant.front(), when) + 0.5 * weather.span_of(0);
    return static_cast<int>(std::floor(known / seconds_of_day + 1e-6));
}

namespace {

constexpr double day = seconds_of_day;  // [s]

/// A span in progress, day by day.
struct Walk {
    std::span<const SpanStage> stages;
    const SolveInput& input;  // the first stage's
    const SpanOptions& options;
    SpanResult result;
    HeatState state;
    PackedField day_before{};  // every step of the last piece
    int days = 0, all_days = 1;
    bool repeats_itself = false;  // the last piece, stepped on from its end, is the same again

    const SpanStage& stage_at(Instant when) const {
        const SpanStage* stage = &stages.front();
        for (const SpanStage& next : stages.subspan(1)) {
            if (next.from <= when) stage = &next;
        }
        return *stage;
    }
    /// Whether a stage begins at an instant which still shows the one before.
    bool shows_before(Instant when) const {
        const SpanStage& stage = stage_at(when);
        return &stage != &stages.front() && stage.from == when && stage.early;
    }
    /// The last instant of the span that is requested.
    Instant last() const {
        return options.until ? std::min(options.end, *options.until) : options.end;
    }
    /// The first change after an instant, or `end`.
    Instant next_change(Instant when, Instant end) const {
        for (const SpanStage& next : stages.subspan(1)) {
            if (next.from > when) return std::min(next.from, end);
        }
        return end;
    }
};

/// The worst of two reports, and what both took.
void add_report(const SolveReport& one, SolveReport& all) {
    const bool first = all.facets == 0;
    all.converged = (first || all.converged) && one.converged;
    all.facets = one.facets;
    all.steps += one.steps;
    all.passes = std::max(all.passes, one.passes);
    all.periodic_residual = std::max(all.periodic_residual, one.periodic_residual);
    all.estimated_error = std::max(all.estimated_error, one.estimated_error);
    all.limit = std::max(all.limit, one.limit);
    all.exchange_change = std::max(all.exchange_change, one.exchange_change);
    all.light_change = std::max(all.light_change, one.light_change);
    all.worst_energy_closure = std::max(all.worst_energy_closure, one.worst_energy_closure);
    all.newton_iterations = std::max(all.newton_iterations, one.newton_iterations);
    all.worst_newton_iterations =
        std::max(all.worst_newton_iterations, one.worst_newton_iterations);
    all.bisections += one.bisections;
    all.points = std::max(all.points, one.points);
    all.point_passes = std::max(all.point_passes, one.point_passes);
    all.limited += one.limited;
    if (all.unsolved.empty()) all.unsolved = one.unsolved;
    all.batched = std::max(all.batched, one.batched);
    all.stores = std::max(all.stores, one.stores);
    all.unfollowed = std::max(all.unfollowed, one.unfollowed);
    all.most_dew_unfollowed = std::max(all.most_dew_unfollowed, one.most_dew_unfollowed);
    all.target_facets = one.target_facets;
    all.target_residual = std::max(all.target_residual, one.target_residual);
    all.dew_left_out = std::max(all.dew_left_out, one.dew_left_out);
    all.stores_held = std::max(all.stores_held, one.stores_held);
    all.store_growth = std::max(all.store_growth, one.store_growth);
    all.alternating = std::max(all.alternating, one.alternating);
    all.alternation = std::max(all.alternation, one.alternation);
    if (all.alternating_facet.empty()) all.alternating_facet = one.alternating_facet;
    if (!one.converged || all.furthest.empty()) all.furthest = one.furthest;
    all.worst_water_closure = std::max(all.worst_water_closure, one.worst_water_closure);
    all.coldest = first ? one.coldest : std::min(all.coldest, one.coldest);
    all.warmest = std::max(all.warmest, one.warmest);
    all.exchange_seconds += one.exchange_seconds;
    all.step_seconds += one.step_seconds;
    all.step_cpu_seconds += one.step_cpu_seconds;
    all.seconds += one.seconds;
}

/// Keeps the wanted instants of a solve from `from` to `to`, between the steps around them: of
/// [start, end), and the end if it is the last. An instant at which a stage begins early is the end
/// of the steps before.
void keep(const TemperatureField& steps, Instant from, Instant to, bool last, Walk& walk) {
    const std::vector<Instant>& wanted = walk.options.wanted;
    TemperatureField& kept = walk.result.temperature;
    kept.kelvin.reserve(wanted.size() * steps.facets);
    const auto begin = std::lower_bound(wanted.begin(), wanted.end(), from);
    for (auto when = begin; when != wanted.end(); ++when) {
        if (*when > to) break;
        const bool starts = *when == from, ends = *when == to;
        if (starts && *when > walk.options.start && walk.shows_before(*when)) continue;
        if (ends && !last && !walk.shows_before(*when)) break;
        const std::vector<float> row = steps.interpolate(*when);
        kept.instant.push_back(*when);
        kept.facets = steps.facets;
        if (!steps.water.empty() || !kept.water.empty()) {
            add_row(steps.water.facet, steps.cover_at(*when), kept.instant.size() - 1, kept.water);
        }
        kept.kelvin.insert(kept.kelvin.end(), row.begin(), row.end());
    }
}

struct Piece {
    Instant from, to;
    bool periodic = false, goes_on = true, keeping = true;
    const Weather* weather = nullptr;  // null: the input's
};

/// The wanted instants whose heat balance a piece reports: those behind its start, where no step
/// has led yet, and its start if nothing goes before.
std::span<const Instant> reported_by(const Piece& piece, const Walk& walk) {
    const std::vector<Instant>& wanted = walk.options.wanted;
    const bool leads_in = !piece.periodic && piece.to == walk.options.start;
    if (!walk.options.heat || !(piece.keeping || leads_in)) return {};
    const bool first = walk.result.heat.empty();
    const auto begin = first ? std::lower_bound(wanted.begin(), wanted.end(), piece.from)
                             : std::upper_bound(wanted.begin(), wanted.end(), piece.from);
    return {begin, std::upper_bound(begin, wanted.end(), piece.to)};
}

/// The steps at or on either side of some instants.
std::vector<std::size_t> steps_around(std::span<const Instant> wanted,
                                      const std::vector<Instant>& steps) {
    std::vector<std::size_t> around;
    const auto add = [&](std::size_t i) {
        if (around.empty() || around.back() < i) around.push_back(i);
    };
    for (const Instant when : wanted) {
        const auto at = std::lower_bound(steps.begin(), steps.end(), when);
        const auto i = static_cast<std::size_t>(at - steps.begin());
        if (*at != when) add(i - 1);
        add(i);
    }
    return around;
}

/// The input of a piece: its own sun, weather (null: the span's) and start, all else the span's. A
/// member that is not named here is no silent loss: the list has to match.
SolveInput of_piece(const SolveInput& span, const SunExposure& sun, const Weather* own_weather,
                    const HeatState* from) {
    const auto& [facets, views, span_sun, materials, weather, site, clock, elevation, by_height,
                 height, part, beside, network, open_above, clear_sky, measured_share,
                 sunlight_views, span_from] = span;
    return {
        facets,         views,          sun,       materials,  own_weather ? *own_weather : weather,
        site,           clock,          elevation, by_height,  height,
        part,           beside,         network,   open_above, clear_sky,
        measured_share, sunlight_views, from};
}

/// Of a similar solve the same piece, with as many facets; null: none.
const SpanCourse::Piece* like_piece(const Piece& piece, const SpanStage& stage, const Walk& walk) {
    if (!walk.options.like) return nullptr;
    for (const SpanCourse::Piece& one : walk.options.like->piece) {
        const bool covers = piece.periodic ? one.to == piece.to : one.to >= piece.to;
        if (one.from == piece.from && covers && one.periodic == piece.periodic &&
            one.steps.facets == stage.input.facets.size()) {
            return &one;
        }
    }
    return nullptr;
}

/// Temperatures at every one of some steps.
PackedField at_steps(const TemperatureField& field, const std::vector<Instant>& steps) {
    PackedField there = PackedField::of_steps(steps.size(), 1, field.facets);
    std::vector<float> values(PackedField::run * field.facets);
    for (std::size_t r = 0; r < there.runs(); ++r) {
        const std::size_t width = there.width(r);
        for (std::size_t k = 0; k < width; ++k) {
            const std::vector<float> row = field.interpolate(steps[r * PackedField::run + k]);
            for (std::size_t f = 0; f < field.facets; ++f) values[f * width + k] = row[f];
        }
        for (std::size_t f = 0; f < field.facets; ++f) there.put(r, f, &values[f * width]);
    }
    return there;
}

/// The steps whose temperatures a piece stores: those around its wanted instants.
std::vector<std::size_t> stored_steps(const Piece& piece, const std::vector<Instant>& wanted,
                                      const std::vector<Instant>& steps) {
    if (!piece.keeping) return {};
    const auto begin = std::lower_bound(wanted.begin(), wanted.end(), steps.front());
    return steps_around({begin, std::upper_bound(begin, wanted.end(), steps.back())}, steps);
}

/// Solves a piece, from the walk's state if it has one, and leaves there what comes of it.
void solve_piece(const Piece& piece, Walk& walk) {
    SolveOptions options = walk.options.day;
    options.start = piece.from;
    options.duration = seconds_between(piece.from, piece.to);
    options.periodic = piece.periodic;
    options.goes_on = piece.goes_on || walk.options.goes_on;
    options.leads_in = !piece.keeping;
    // Without the day before to guess by, the first pass meets neighbours that rest; another makes
    // up for it.
    const SpanStage& stage = walk.stage_at(piece.from);
    const bool changed = !piece.periodic && stage.from == piece.from && walk.stages.size() > 1;
    const SpanCourse::Piece* const like = like_piece(piece, stage, walk);
    if (changed || (!like && walk.options.begin == SpanStart::state && walk.days == 0)) {
        options.settled = 1e-3;
    }
    const double done = walk.days++, all = std::max(walk.days, walk.all_days);
    if (walk.options.day.progress) {
        options.progress = [&](double share) { walk.options.day.progress((done + share) / all); };
    }
    const std::vector<Instant> steps = step_instants(options);
    const std::span<const Instant> reported = reported_by(piece, walk);
    options.heat_at = steps_around(reported, steps);
    if (walk.options.keep_course) {
        options.keep_every = 0.0;  // every step
    } else {
        options.keep_at = stored_steps(piece, walk.options.wanted, steps);
    }
    SunExposure sun = stage.exposure(steps);
    const bool begun = !piece.periodic && !walk.state.block.empty();
    const HeatState* from = begun ? &walk.state : nullptr;
    PackedField guess = std::exchange(walk.day_before, {});
    if (!begun || walk.days <= 1 || changed) guess = {};
    if (like && piece.periodic) from = &like->end;
    if (like && from) guess = at_steps(like->steps, steps);
    SolveResult result = solve(of_piece(stage.input, sun, piece.weather, from), options,
                               {.sun = &sun,
                                .guess = std::move(guess),
                                .from = from == &walk.state ? &walk.state : nullptr});
    add_report(result.report, walk.result.report);
    if (piece.periodic) {
        walk.result.repeated = result.report.converged;
        walk.result.repeated_error = result.report.estimated_error;
    }
    walk.repeats_itself = piece.periodic && result.report.converged &&
                          result.report.stores_held == 0 && result.report.alternating == 0;
    for (const Instant when : reported) walk.result.heat.add_between(result.heat, when);
    if (piece.keeping) {
        keep(result.temperature, steps.front(), steps.back(), piece.to >= walk.last(), walk);
    }
    if (walk.options.keep_course) {
        walk.result.course.piece.push_back(
            {piece.from, piece.to, piece.periodic, result.end, std::move(result.temperature)});
    }
    walk.state = std::move(result.end);
    walk.day_before = std::move(result.steps);
}

/// To the state that a day without its trend, again and again, leads to. Returns the instant at
/// which days go on: at that day's own start, as it has a trend; at its end if it has none, since
/// it would only be the same again.
Instant repeat_day(Instant from, Walk& walk) {
    const Weather weather = without_trend(walk.input.weather, from);
    solve_piece({.from = from,
                 .to = later(from, day),
                 .periodic = true,
                 .keeping = false,
                 .weather = &weather},
                walk);
    const Instant next = later(from, day);
    const bool same = walk.repeats_itself && !has_trend(walk.input.weather, from) &&
                      next <= walk.options.start && walk.next_change(from, next) == next;
    if (same) --walk.all_days;
    return same ? next : from;
}

/// From one instant to another in days.
void go_on(Instant from, Instant to, bool keeping, Walk& walk) {
    for (Instant begin = from; begin < to;) {
        Instant end = std::min(to, later(begin, day));
        if (seconds_between(end, to) < walk.options.day.step) end = to;  // no crumbs
        end = walk.next_change(begin, end);
        solve_piece({.from = begin, .to = end, .keeping = keeping}, walk);
        begin = end;
    }
}

/// The span from or within a day that repeats from `first` on: that day, and what follows it.
void go_round(Instant first, Walk& walk) {
    const Instant end = walk.options.end, next = later(first, day);
    const bool on = next < end || walk.options.goes_on;
    solve_piece({.from = first, .to = next, .periodic = true, .goes_on = on}, walk);
    if (next <= end) {
        go_on(next, walk.last(), true, walk);
    } else if (walk.options.goes_on) {
        // What the day ends with is what it began with, not what is there at the span's end.
        go_on(first, end, false, walk);
    }
}

bool known_until(const Weather& weather, Instant when) {
    const double half = 0.5 * weather.span_of(weather.instant.size() - 1);
    return seconds_between(when, later(weather.instant.back(), half)) > -3600.0;
}

/// Where a day that is to repeat begins best: at the start, or steps before it; where the series
/// holds all of it and, as tomorrow's sun rises half a minute off, in the dark near solar midnight.
Instant day_around(const SolveInput& input, Instant start, double step) {
    const auto dark = [&](Instant when) {
        return sun_position(input.site, when).elevation_deg < -1.0;
    };
    const Weather& weather = input.weather;
    const Instant first = later(weather.instant.front(), -0.5 * weather.span_of(0));
    const Instant last =
        later(weather.instant.back(), 0.5 * weather.span_of(weather.instant.size() - 1));
    // Steps back to a day before the last row, to the first one, and to midnight.
    const double least = std::ceil((seconds_between(last, start) + day) / step - 1e-9);
    const double most = std::floor(seconds_between(first, start) / step + 1e-9);
    if (least > most || (least <= 0.0 && dark(start))) return start;
    const double since = std::chrono::duration<double>(start.time_since_epoch()).count();
    const double ahead = input.site.longitude_deg * 240.0;  // [s] of mean solar time before UTC
    const double of_day = std::fmod(std::fmod(since + ahead, day) + day, day);
    const double back = std::clamp(std::round(of_day / step), std::max(0.0, least), most);
    const Instant found = later(start, -step * back);
    return least > 0.0 || dark(found) ? found : start;
}

void from_the_weather_before(int days, Walk& walk) {
    const SpanOptions& options = walk.options;
    const Instant first = later(options.start, -day * days);
    walk.all_days += days;
    go_on(repeat_day(first, walk), options.start, false, walk);
    go_on(options.start, walk.last(), true, walk);
    walk.result.start = fmt::format("from {} day{} of earlier weather, the first one repeated",
                                    days, days == 1 ? "" : "s");
}

void from_a_repeated_day(Walk& walk) {
    const Weather& weather = walk.input.weather;
    const Instant start = walk.options.start, end = walk.options.end;
    Instant first = day_around(walk.input, start, walk.options.day.step);
    if (!known_until(weather, later(first, day)) && days_known_before(weather, start) >= 1) {
        first = later(start, -day);
    } else if (repeats(weather, first) && walk.next_change(first, end) == end) {
        go_round(first, walk);
        walk.result.start = "the day is repeated";
        return;
    }
    go_on(repeat_day(first, walk), start, false, walk);
    go_on(start, walk.last(), true, walk);
    walk.result.start =
        fmt::format("the day {} repeated without its trend",
                    first < start ? "around or before the start" : "that begins at the start");
}

}  // namespace

SpanResult solve_span(const SolveInput& input, const ExposureOf& exposure,
                      const SpanOptions& options) {
    const SpanStage only{options.start, input, exposure};
    return solve_span({&only, 1}, options);
}

SpanResult solve_span(std::span<const SpanStage> stages, const SpanOptions& options) {
    const SolveInput& input = stages.front().input;
    Walk walk{.stages = stages, .input = input, .options = options, .result = {}, .state = {}};
    const double length = seconds_between(options.start, walk.last());
    walk.all_days = static_cast<int>(std::ceil(length / day - 1e-9));
    const int known = days_known_before(input.weather, options.start);
    if (options.begin == SpanStart::state && options.from) {
        walk.state = *options.from;
        go_on(options.start, walk.last(), true, walk);
        walk.result.start = "saved state";
    } else if (options.begin == SpanStart::steady) {
        go_on(options.start, walk.last(), true, walk);
        walk.result.start = "balance of the first day's mean";
    } else if (options.begin != SpanStart::periodic && known >= 1) {
        from_the_weather_before(std::min(known, options.days_before), walk);
    } else {
        from_a_repeated_day(walk);
        if (options.begin == SpanStart::weather) {
            walk.result.start += " (the weather file has no day before the span)";
        }
    }
    walk.result.end = std::move(walk.state);
    return std::move(walk.result);
}

}  // namespace diurna
