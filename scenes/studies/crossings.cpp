#include "scenes/studies/crossings.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <utility>

namespace diurna {

namespace {

namespace tools = boost::math::tools;

constexpr std::uintmax_t most_asked = 60;
constexpr int most_secants = 6;
constexpr double slope_reach = 60.0;  // [s]

struct At {
    double time, value;
};

/// Requested crossings within [first, last] s.
struct Asked {
    const Difference& difference;
    double first, last;

    double operator()(double time) const { return difference(time); }
    double slope(double time) const {
        const double before = std::max(first, time - slope_reach);
        const double after = std::min(last, time + slope_reach);
        return (difference(after) - difference(before)) / (after - before);
    }
};

/// A zero, or a bracket about it that is no wider than requested.
struct Narrowed {
    At low, high;
    std::optional<double> zero;
};

/// Narrows the bracket of a zero between two times of other sign, to `width`: secants (Anderson and
/// Bjorck 1973), until the value is less than the secant makes in half of it, or the bracket is as
/// narrow; halves where a jump keeps secants from it.
template <class Function>
Narrowed narrowed(const Function& difference, At low, At high, double width) {
    double of_low = low.value, of_high = high.value;  // as the secants take them
    int side = 0;
    for (int i = 0; i < int(most_asked) && high.time - low.time > width; ++i) {
        const double slope = (of_high - of_low) / (high.time - low.time);
        const double time = i < most_secants
                                ? std::clamp(low.time - of_low / slope, low.time + 0.1 * width,
                                             high.time - 0.1 * width)
                                : 0.5 * (low.time + high.time);
        const At at{time, difference(time)};
        if (std::abs(at.value) <= 0.5 * width * std::abs(slope)) {
            return {low, high, at.time - at.value / slope};
        }
        const bool below = (at.value < 0.0) == (low.value < 0.0);
        At& moved = below ? low : high;
        double& other = below ? of_high : of_low;
        const int now = below ? -1 : 1;
        if (now == side) {
            const double left = 1.0 - at.value / (below ? of_low : of_high);
            other *= left > 0.0 ? left : 0.5;
        }
        side = now;
        moved = at;
        (below ? of_low : of_high) = at.value;
    }
    return {low, high, std::nullopt};
}

/// The zero between two times of other sign.
ZeroCrossing between(const At& a, const At& b, const Asked& difference,
                     const CrossingSearch& search) {
    ZeroCrossing found;
    if (a.value == 0.0 || b.value == 0.0) {
        found.at = a.value == 0.0 ? a.time : b.time;
        if (b.value == 0.0) found.at = b.time;
        found.slope = difference.slope(found.at);
        return found;
    }
    const auto [low, high, zero] = narrowed(difference, a, b, search.width);
    if (zero) {
        found.at = *zero;
        found.slope = difference.slope(found.at);
        return found;
    }
    const double step = high.value - low.value, width = std::max(high.time - low.time, 1e-3);
    found.at = low.time - low.value * (high.time - low.time) / step;
    if (std::abs(step) > search.jumping) {
        found.kind = ZeroCrossing::Kind::jumps;
        found.slope = step / width;
        return found;
    }
    found.slope = difference.slope(found.at);
    return found;
}

/// About a time at which the magnitude is least of three.
void about(const At& a, const At& middle, const At& b, const Asked& difference,
           const CrossingSearch& search, std::vector<ZeroCrossing>& found) {
    const double sign = middle.value > 0.0 ? 1.0 : -1.0;
    // By the parabola: what it is far from is not looked at.
    const double left = (middle.value - a.value) / (middle.time - a.time);
    const double right = (b.value - middle.value) / (b.time - middle.time);
    const double bend =
        std::abs(right - left) * std::max(b.time - middle.time, middle.time - a.time);
    if (std::abs(middle.value) > search.touching + bend) return;
    std::uintmax_t asked = most_asked;
    const int bits = std::clamp(
        int(std::ceil(std::log2((std::abs(a.time) + std::abs(b.time) + 1.0) / search.width))), 4,
        26);
    const auto [at, least] = tools::brent_find_minima(
        [&](double t) { return sign * difference(t); }, a.time, b.time, bits, asked);
    const At bottom{at, sign * least};
    if (least <= 0.0) {
        found.push_back(between(a, bottom, difference, search));
        if (least < 0.0) found.push_back(between(bottom, b, difference, search));
        if (least == 0.0) found.back().kind = ZeroCrossing::Kind::touches;
    } else if (least < search.touching) {
        found.push_back(
            {.at = at, .slope = 0.0, .least = bottom.value, .kind = ZeroCrossing::Kind::touches});
    }
}

}  // namespace

std::vector<ZeroCrossing> find_crossings(std::span<const double> time,
                                         std::span<const double> value, const Difference& asked,
                                         const CrossingSearch& search) {
    if (time.empty()) return {};
    const Asked difference{asked, time.front(), time.back()};
    std::vector<ZeroCrossing> found;
    const auto at = [&](std::size_t i) { return At{time[i], value[i]}; };
    const auto same = [&](std::size_t i, std::size_t k) { return value[i] * value[k] > 0.0; };
    for (std::size_t i = 0; i < time.size(); ++i) {
        const bool last = i + 1 == time.size();
        if (value[i] == 0.0) {
            // Within a stretch of zeros there is no crossing to be reported.
            if (last || i == 0 || value[i + 1] == 0.0 || value[i - 1] == 0.0) continue;
            found.push_back(between(at(i - 1), at(i), difference, search));
            if (same(i - 1, i + 1)) found.back().kind = ZeroCrossing::Kind::touches;
        } else if (!last && value[i] * value[i + 1] < 0.0) {
            found.push_back(between(at(i), at(i + 1), difference, search));
        } else if (i > 0 && !last && same(i - 1, i) && same(i, i + 1) &&
                   std::abs(value[i]) <= std::abs(value[i - 1]) &&
                   std::abs(value[i]) < std::abs(value[i + 1])) {
            about(at(i - 1), at(i), at(i + 1), difference, search, found);
        }
    }
    std::sort(found.begin(), found.end(),
              [](const ZeroCrossing& a, const ZeroCrossing& b) { return a.at < b.at; });
    return found;
}

std::optional<double> nearest_crossing(const ZeroCrossing& like, const Difference& difference,
                                       double reach, double first, double last, double width) {
    const double sign = like.slope > 0.0 ? 1.0 : -1.0;  // it rises, so taken
    const auto rising = [&](double t) { return sign * difference(t); };
    At from{like.at, rising(like.at)};
    if (from.value == 0.0) return from.time;
    const double way = from.value < 0.0 ? 1.0 : -1.0;
    double step = std::clamp(1.2 * std::abs(from.value / like.slope), 30.0, 1800.0);
    while (true) {
        const double next = std::clamp(from.time + way * step, std::max(first, like.at - reach),
                                       std::min(last, like.at + reach));
        if (next == from.time) return std::nullopt;
        const At to{next, rising(next)};
        if (to.value * way >= 0.0) {
            const At low = way > 0.0 ? from : to, high = way > 0.0 ? to : from;
            if (low.value == 0.0) return low.time;
            if (high.value == 0.0) return high.time;
            const Narrowed at = narrowed(rising, low, high, width);
            return at.zero.value_or(0.5 * (at.low.time + at.high.time));
        }
        from = to;
        step = std::min(2.0 * step, 1800.0);
    }
}

double time_below(std::span<const double> time, std::span<const double> value, double threshold) {
    double sum = 0.0;
    for (std::size_t i = 0; i + 1 < time.size(); ++i) {
        const double a = value[i], b = value[i + 1], span = time[i + 1] - time[i];
        if (a == b) {
            if (std::abs(a) < threshold) sum += span;
            continue;
        }
        // Shares of the way at which it is at either end of the strip.
        double in = (-threshold - a) / (b - a), out = (threshold - a) / (b - a);
        if (in > out) std::swap(in, out);
        sum += span * std::max(0.0, std::min(out, 1.0) - std::max(in, 0.0));
    }
    return sum;
}

}  // namespace diurna
