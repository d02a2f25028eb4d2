#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

/// Where a difference that is known at some times, and can be asked for at any, is zero.
namespace diurna {

using Difference = std::function<double(double)>;  // of a time [s]

struct ZeroCrossing {
    enum class Kind {
        crosses,  // from one side to the other
        jumps,    // likewise, but from one moment to the next: a shadow's edge, the sun's rise
        touches   // comes near zero, and goes back
    };
    double at = 0.0;     // [s]
    double slope = 0.0;  // of the difference there [1/s]; of what jumps its step over `width`
    double least = 0.0;  // the difference where it touches; 0 else
    Kind kind = Kind::crosses;
};

struct CrossingSearch {
    double width = 1.0;      // [s] to which times are found
    double touching = 0.0;   // a least difference below it counts as touching
    double jumping = 1e300;  // a step within `width` above it counts as a jump
};

// Of apparent temperatures of a scene.
inline constexpr double found_to = 0.5;               // [s]
inline constexpr double jump = 0.05;                  // [K] within that
inline constexpr double farthest_shift = 3.0 * 3600;  // [s] that a changed number may move one by

/// All of them, ascending. Between two times of other sign one is found by a bracketed search
/// (Alefeld, Potra and Shi 1995, ACM Trans. Math. Softw. 21: its error is below `width`); about a
/// least magnitude it is followed to its minimum, which gives two crossings, one that touches, or
/// none. What comes and goes between two times by more than the parabola through three of them is
/// not seen.
///
/// - time: ascending; value: the difference there, as many
std::vector<ZeroCrossing> find_crossings(std::span<const double> time,
                                         std::span<const double> value,
                                         const Difference& difference,
                                         const CrossingSearch& search);

/// The crossing of a difference like one that has been found, at most `reach` away from where that
/// was; none where there is none.
///
/// - first, last: beyond these the difference is not asked for [s]
std::optional<double> nearest_crossing(const ZeroCrossing& like, const Difference& difference,
                                       double reach, double first, double last, double width);

/// How long a difference is nearer to zero than `threshold` [s], going straight from one time to
/// the next.
double time_below(std::span<const double> time, std::span<const double> value, double threshold);

}  // namespace diurna
