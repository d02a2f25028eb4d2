#include "thermal/solve/clock_hours.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace diurna {

double ClockHours::mean(Instant from, Instant to) const {
    if (window.empty()) return 1.0;
    constexpr double day = 86400.0;
    const auto on_clock = [&](Instant when) {
        return std::chrono::duration<double>(when.time_since_epoch()).count() + utc_offset;
    };
    const double begin = on_clock(from), end = on_clock(to);
    const auto first = static_cast<long>(std::floor(begin / day)) - 1;
    const auto last = static_cast<long>(std::floor(end / day));
    double sum = 0.0;
    for (const Window& w : window) {
        for (long d = w.day.value_or(first); d <= w.day.value_or(last); ++d) {
            const double on = double(d) * day + w.from, off = double(d) * day + w.to;
            sum += w.share * std::max(0.0, std::min(end, off) - std::max(begin, on));
        }
    }
    return sum / std::max(1e-9, end - begin);
}

}  // namespace diurna
