#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

/// Zero crossings of a difference known at some times, which can be evaluated at any time.
namespace diurna {

using Difference = std::function<double(double)>;  // of a time [s]

struct ZeroCrossing {
    enum class Kind {
        crosses,  // from one side to the other
        jumps,    // the same, but instantaneous: a shadow's edge, sunrise
        touches   // comes near zero, and returns
    };
    double at = 0.0;     // [s]
    double slope = 0.0;  // of the difference there [1/s]; for a jump its step
    double least = 0.0;  // minimum difference of a touch; 0 otherwise
    Kind kind = Kind::crosses;
};

struct CrossingSearch {
    double width = 1.0;      // [s] accuracy of times
    double touching = 0.0;   // a smaller minimum difference counts as touching
    double jumping = 1e300;  // a larger step within `width` counts as a jump
};

// For apparent temperatures of a scene.
inline constexpr double found_to = 0.5;               // [s]
inline constexpr double jump = 0.05;                  // [K] within that
inline constexpr double farthest_shift = 3.0 * 3600;  // [s] largest shift due to a changed number

/// All crossings, ascending. Between two times of opposite sign one is found by bracketed secants
/// (Anderson and Bjorck 1973, BIT 13: its error is below `width`), or halves where it jumps;
/// near a minimum of the magnitude the minimum is located, which gives two crossings, a touch, or
/// none. Excursions between two times that exceed the parabola through three of them are not
/// detected.
///
/// - time: ascending; value: the difference there, same length
std::vector<ZeroCrossing> find_crossings(std::span<const double> time,
                                         std::span<const double> value,
                                         const Difference& difference,
                                         const CrossingSearch& search);

/// The crossing of a similar difference nearest to a known
/// one, at most `reach` away; nothing if there is none.
///
/// - first, last: limits of evaluation of the difference
///   [s]
std::optional<double> nearest_crossing(const ZeroCrossing& like, const Difference& difference,
                                       double reach, double first, double last, double width);

/// Duration for which a difference is below `threshold` in magnitude [s], linear from one time to
/// the next.
double time_below(std::span<const double> time, std::span<const double> value, double threshold);

}  // namespace diurna
