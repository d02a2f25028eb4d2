#pragma once

#include <string>
#include <vector>

#include "scenes/studies/crossover.hpp"

namespace diurna {

/// A line for each crossing: band, time, kind, which is warmer afterwards, slope, standard
/// deviation, and the change for each uncertain number; empty if there is no crossing then.
///
/// - utc_offset: [s] of the scene's clock
std::string crossover_csv(const CrossoverInput& input, const CrossoverReport& report,
                          double utc_offset);

/// A line for each instant and band: both apparent temperatures, and the difference [K].
std::string contrast_curves_csv(const CrossoverReport& report, double utc_offset);

/// Settings, crossings, hours without contrast.
std::string crossover_json(const CrossoverInput& input, const std::string& observer,
                           const CrossoverReport& report, const std::vector<std::string>& notes,
                           double utc_offset);

/// The difference over the hours, its threshold, and the crossings; a chart for each band.
std::string crossover_svg(const CrossoverInput& input, const CrossoverReport& report,
                          double utc_offset);

/// "crosses", "jumps", "touches".
const char* word_of(ZeroCrossing::Kind kind);
/// Keys of the uncertain numbers for which there is no crossing.
std::vector<std::string> gone_with(const CrossoverInput& input, const TimedCrossing& crossing);

}  // namespace diurna
