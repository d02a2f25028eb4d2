#include "thermal/weather/cropped_weather.hpp"

#include <algorithm>
#include <utility>

namespace diurna {

namespace {

constexpr std::size_t few_rows = 100'000;
constexpr double days_before = 40.0, days_behind = 3.0, a_day = 86400.0;

template <class Value>
void keep(std::vector<Value>& all, std::ptrdiff_t from, std::ptrdiff_t to) {
    if (all.empty()) return;
    all = std::vector<Value>(all.begin() + from, all.begin() + to);
}

}  // namespace

Weather cropped(Weather weather, Instant first, Instant last) {
    if (weather.instant.size() <= few_rows) return weather;
    const auto begin = weather.instant.begin(), end = weather.instant.end();
    auto from = std::lower_bound(begin, end, later(first, -a_day * days_before));
    auto to = std::upper_bound(from, end, later(last, a_day * days_behind));
    if (from == end) --from;  // held beyond its ends: a row stays on either side
    if (to == begin) ++to;
    if (from == to) --from;
    const std::ptrdiff_t f = from - begin, t = to - begin;
    keep(weather.sample, f, t);
    keep(weather.span, f, t);
    keep(weather.instant, f, t);
    return weather;
}

}  // namespace diurna
