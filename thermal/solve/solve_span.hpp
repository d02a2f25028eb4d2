#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "thermal/solve/solver.hpp"

namespace diurna {

/// What went before a span.
enum class SpanStart {
    known,     // the weather where the series has a day of it, else periodic
    weather,   // the days before it, as the weather reports; the first of them repeated
    periodic,  // its first 24 hours, or the 24 before it, again and again without their trend
    steady,    // the balance of its first day's means, for ever
    state,     // SpanOptions::from
};

/// The days of a span one after the other, each stepped as `day` says but for its start, duration
/// and whether it repeats.
struct SpanOptions {
    SolveOptions day{};
    Instant start{}, end{};
    SpanStart begin = SpanStart::known;
    int days_before = 3;              // at most, of SpanStart::weather
    std::vector<Instant> wanted{};    // ascending, within the span: when temperatures are kept
    bool heat = false;                // and heat balances
    const HeatState* from = nullptr;  // of SpanStart::state: the heat at the start
    bool goes_on = false;  // another span follows from SpanResult::end: what is slower than a day
                           // is kept
};

/// Whole days of weather that a series has before an instant; negative where it begins later.
int days_known_before(const Weather& weather, Instant when);

/// The share of each facet that the sun reaches at each of some instants.
using ExposureOf = std::function<SunExposure(const std::vector<Instant>& instants)>;

/// What a span's facets see and meet from an instant on, until the next stage: the same facets of
/// the same materials, some of them in other places.
struct SpanStage {
    Instant from;
    const SolveInput& input;
    ExposureOf exposure;
    bool early = false;  // at `from` itself all is still as in the stage before
};

struct SpanResult {
    TemperatureField temperature;  // at the wanted instants, straight between steps
    SolveReport report;    // of all days: sums of passes, steps and seconds, worst of all else
    bool repeated = true;  // the day that repeats was found, if one had to be
    double repeated_error = 0.0;       // [K] SolveReport::estimated_error of it alone
    std::string start;                 // in one line: how the start was found
    std::vector<std::string> notes{};  // in a line each: what else is to be known of it
    HeatState end{};                   // of the span, where it goes on
    HeatFluxField heat{};  // at the wanted instants, straight between steps; if asked for
};

/// Temperatures of all facets over any span. A day is solved at a time, the next goes on from the
/// heat that it leaves, and no more than a day and the wanted instants are held. Where the first
/// day repeats (thermal/weather/repeated_day.hpp) and none is known before, it is found by Newton
/// and is the span's own.
///
/// A start costs: weather, as many days as go before and a periodic one; periodic, one day, none
/// where the first day repeats. Throws InputError as solve() does.
///
/// Where there are stages, what went before the span is that of the first, and a piece ends with
/// each: heat goes on, facet by facet.
///
/// - stages: one or more, ascending; the first counts from for ever
SpanResult solve_span(std::span<const SpanStage> stages, const SpanOptions& options);

/// - input: its `sun` and `from` are left aside
SpanResult solve_span(const SolveInput& input, const ExposureOf& exposure,
                      const SpanOptions& options);

}  // namespace diurna
