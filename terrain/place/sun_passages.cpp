#include "terrain/place/sun_passages.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

namespace {

constexpr double apart_by = 1200.0;  // [s] of samples: what passes is near enough a sine of a day

Instant whole_second(Instant begin, double seconds) {
    return std::chrono::round<std::chrono::seconds>(later(begin, seconds));
}

/// Where a function of seconds, of opposite signs at both ends, is zero: to a millisecond.
template <class Of>
double root(const Of& of, double from, double to) {
    const bool rises = of(from) < 0.0;
    while (to - from > 1e-3) {
        const double middle = 0.5 * (from + to);
        ((of(middle) < 0.0) == rises ? from : to) = middle;
    }
    return 0.5 * (from + to);
}

/// Where it is greatest, in an interval that holds one summit.
template <class Of>
double summit(const Of& of, double from, double to) {
    while (to - from > 0.1) {
        const double a = from + (to - from) / 3.0, b = to - (to - from) / 3.0;
        (of(a) < of(b) ? from : to) = of(a) < of(b) ? a : b;
    }
    return 0.5 * (from + to);
}

/// Calls passed(seconds, rising) wherever it passes zero from 0 to `duration`.
template <class Of, class Passed>
void each_root(const Of& of, double duration, const Passed& passed) {
    const auto between = [&](double from, double to) {
        if (of(from) < 0.0 && of(to) >= 0.0) passed(root(of, from, to), true);
        if (of(from) >= 0.0 && of(to) < 0.0) passed(root(of, from, to), false);
    };
    double before = 0.0, at = 0.0;
    while (at < duration) {
        const double next = std::min(duration, at + apart_by);
        // A summit between two samples may be above where both are below.
        if (at > before && of(at) < 0.0 && of(at) >= of(before) && of(at) >= of(next)) {
            const double top = summit(of, before, next);
            if (of(top) >= 0.0) {
                between(before, top);
                between(top, next);
            }
        }
        between(at, next);
        before = at;
        at = next;
    }
}

}  // namespace

std::vector<Instant> sun_at_azimuth(const Site& site, Instant from, Instant to,
                                    double azimuth_deg) {
    const Eigen::Vector3d ahead = direction(azimuth_deg, 0.0);
    const Eigen::Vector3d right = direction(azimuth_deg + 90.0, 0.0);
    const auto sun = [&](double seconds) {
        return sun_direction(sun_position(site, later(from, seconds)));
    };
    std::vector<Instant> found;
    each_root([&](double seconds) { return right.dot(sun(seconds)); }, seconds_between(from, to),
              [&](double seconds, bool) {
                  const Eigen::Vector3d there = sun(seconds);
                  if (there.z() > 0.0 && ahead.dot(there) > 0.0) {
                      found.push_back(whole_second(from, seconds));
                  }
              });
    return found;
}

std::vector<Instant> sun_at_elevation(const Site& site, Instant from, Instant to,
                                      double elevation_deg, DayHalf half) {
    std::vector<Instant> found;
    each_root(
        [&](double seconds) {
            return sun_position(site, later(from, seconds)).elevation_deg - elevation_deg;
        },
        seconds_between(from, to),
        [&](double seconds, bool climbs) {
            if (half != (climbs ? DayHalf::afternoon : DayHalf::morning)) {
                found.push_back(whole_second(from, seconds));
            }
        });
    return found;
}

}  // namespace diurna
