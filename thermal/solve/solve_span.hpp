#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "thermal/solve/solver.hpp"

namespace diurna {

/// History before a span.
enum class SpanStart {
    known,     // the weather if the series has a day of it, else periodic
    weather,   // the days before it from the weather; the first of them repeated
    periodic,  // its first 24 hours, or the 24 before it, repeated without their trend
    steady,    // the balance of its first day's means, constant
    state,     // SpanOptions::from
};

/// The pieces of a span as they were solved, for another solve of the same span with other numbers
/// or steps (SpanOptions::like).
struct SpanCourse {
    struct Piece {
        Instant from, to;
        bool periodic = false;
        HeatState end{};           // of a periodic one also its start
        TemperatureField steps{};  // every step
    };
    std::vector<Piece> piece{};
};

/// The days of a span in sequence, each stepped as `day` says except for its start, duration and
/// periodicity.
struct SpanOptions {
    SolveOptions day{};
    Instant start{}, end{};
    /// Instant behind which nothing is requested, so that days before `end` are not solved to
    /// their end; none: `end`. What is before it stays the same.
    std::optional<Instant> until{};
    SpanStart begin = SpanStart::known;
    int days_before = 3;              // at most, of SpanStart::weather
    std::vector<Instant> wanted{};    // ascending, within the span: temperatures are stored
    bool heat = false;                // and heat balances
    const HeatState* from = nullptr;  // of SpanStart::state: the heat at the start
    bool keep_course = false;         // SpanResult::course is requested
    /// First guess of every piece: a similar solve of the same span. The periodic day starts from
    /// its state without steps of an hour. The result converges to the same limits as without.
    const SpanCourse* like = nullptr;
    bool goes_on = false;  // another span continues from SpanResult::end: modes slower than a day
                           // are retained
};

/// Whole days of weather in a series before an instant; negative if it begins later.
int days_known_before(const Weather& weather, Instant when);

/// The share of each facet in the sun at each of some instants.
using ExposureOf = std::function<SunExposure(const std::vector<Instant>& instants)>;

/// Views and surroundings of a span's facets from an instant to the next stage: the same facets of
/// the same materials, some of them moved.
struct SpanStage {
    Instant from;
    const SolveInput& input;
    ExposureOf exposure;
    bool early = false;  // at `from` itself the stage before still applies
};

struct SpanResult {
    TemperatureField temperature;  // at the requested instants, linear between steps
    SolveReport report;    // of all days: sums of passes, steps and seconds, worst of the rest
    bool repeated = true;  // the periodic day converged, if one was needed
    double repeated_error = 0.0;       // [K] SolveReport::estimated_error of that day
    std::string start;                 // how the start was computed, in one line
    std::vector<std::string> notes{};  // one line each, for the report
    HeatState end{};                   // end of the span, if it continues
    SpanCourse course{};               // if requested
    HeatFluxField heat{};  // at the requested instants, linear between steps; if requested
};

/// Temperatures of all facets over any span. One day is solved at a time, the next continues from
/// its end state, and only a day and the requested instants are in memory. If the first day repeats
/// (thermal/weather/repeated_day.hpp) and no earlier one is known, it is computed by Newton and is
/// part of the span.
///
/// Cost of a start: weather, the preceding days plus a periodic one; periodic, one day, none if the
/// first day repeats. Throws InputError as solve() does.
///
/// With stages, the history before the span is that of the first stage, and a part of the span ends
/// at each: the heat continues, facet by facet.
///
/// - stages: one or more, ascending; the first has no beginning
SpanResult solve_span(std::span<const SpanStage> stages, const SpanOptions& options);

/// - input: its `sun` and `from` are not used
SpanResult solve_span(const SolveInput& input, const ExposureOf& exposure,
                      const SpanOptions& options);

}  // namespace diurna
