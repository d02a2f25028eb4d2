#pragma once

#include <string>
#include <vector>

#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// What a span's start is worth, measured: level ground in the open, a facet of each material of
/// the scene, goes through the same start and through a better one, and through what of the span
/// follows, two days at most.
///
/// The better start: more days of weather, up to 30, if the series has them, and before these their
/// mean day repeated; else a repeated day in
/// place of a steady one; else, where the span already starts from all days there are, the same
/// with a day less, which reports rather too much. Slopes, walls and what neighbours do are not in
/// it.
struct StartError {
    enum class Against { nothing, more_days, repeated_day, a_day_less };
    Against against = Against::nothing;  // nothing: no weather is known from before the start
    int days = 0;                        // that the better start (or the day less) takes
    std::string worst;                   // the material that it is worth most for
    double at_first = 0.0;  // [K] largest difference of any material at the first wanted instant
    double mean = 0.0;      // [K] rms over materials there
    double later_h = 0.0;   // [h] from there to the last instant compared
    double at_later = 0.0;  // [K] largest there; 0 where later_h is
};

/// A start from a state has none: SpanStart::state is refused by an assertion.
StartError measure_start(const SolveInput& input, const SpanOptions& options);

/// In one line, after how the start was found.
std::string reported(const StartError& error);

}  // namespace diurna
