#pragma once

#include <string>
#include <vector>

#include "thermal/solve/solve_span.hpp"

namespace diurna {

/// Effect of a span's start, measured: level ground in the open, one facet of each material of the
/// scene, is run from the same start and from a better one, over the following part of the span,
/// two days at most.
///
/// The better start: more days of weather, up to 30, if the series has them,
/// and before these their mean day repeated; else a periodic day instead of a
/// steady one; else, if the span already uses all available days, the same with
/// one day less, which overestimates. Slopes, walls and neighbours are not
/// included.
struct StartError {
    enum class Against { nothing, more_days, repeated_day, a_day_less };
    Against against = Against::nothing;  // nothing: no earlier weather is known
    int days = 0;                        // of the better start (or the one with a day less)
    std::string worst;                   // the material with the largest effect
    double at_first = 0.0;  // [K] largest difference of any material at the first wanted instant
    double mean = 0.0;      // [K] rms over materials there
    double later_h = 0.0;   // [h] from there to the last instant compared
    double at_later = 0.0;  // [K] largest there; 0 where later_h is
};

/// Not for SpanStart::state (assertion).
StartError measure_start(const SolveInput& input, const SpanOptions& options);

/// One line for the report, after the line on the start.
std::string reported(const StartError& error);

}  // namespace diurna
