#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scenes/job/warnings/scene_warnings.hpp"

namespace diurna {

namespace {

/// Measured sunlight of a sample on the horizontal [W m⁻²]; NaN if there is none.
double sunlight_of(const Forcing& f) {
    return std::isnan(f.shortwave_down) ? f.direct_normal : f.shortwave_down;
}

/// Sunlight that steps miss: rows between two steps against the straight line between these.
struct Missed {
    double square = 0.0;    // [W² m⁻⁴] sum
    std::size_t count = 0;  // of rows by day
    std::vector<double> interval{};

    double rms() const { return count > 0 ? std::sqrt(square / double(count)) : 0.0; }
};

Missed missed_by_steps(const Weather& weather, const TimeInput& time) {
    Missed missed;
    const double duration = seconds_between(time.start, time.end());
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        const double at = seconds_between(time.start, weather.instant[i]);
        if (at < 0.0 || at > duration) continue;
        if (i > 0) {
            missed.interval.push_back(seconds_between(weather.instant[i - 1], weather.instant[i]));
        }
        const double measured = sunlight_of(weather.sample[i]);
        const double step = std::floor(at / time.step);
        const double from = sunlight_of(weather.at(later(time.start, step * time.step)));
        const double to = sunlight_of(weather.at(later(time.start, (step + 1.0) * time.step)));
        if (!(measured > 0.0) || std::isnan(from) || std::isnan(to)) continue;
        const double difference = measured - std::lerp(from, to, at / time.step - step);
        missed.square += difference * difference;
        ++missed.count;
    }
    return missed;
}

}  // namespace

std::vector<Mistake> step_warnings(const Prepared& prepared) {
    constexpr double little = 25.0;  // [W m⁻²] half a kelvin of thin sheet in a light wind
    const Scene& scene = prepared.scene;
    Missed missed = missed_by_steps(prepared.weather, scene.time);
    if (missed.interval.empty() || missed.rms() < little) return {};
    const auto middle = missed.interval.begin() + std::ptrdiff_t(missed.interval.size() / 2);
    std::nth_element(missed.interval.begin(), middle, missed.interval.end());
    if (*middle > 0.75 * scene.time.step) return {};
    return {
        {fmt::format("{}: time.step_s", scene.file.string()),
         fmt::format("the weather has a row every {:g} s, the heat balance a step every {:g} s: "
                     "sunlight between the steps differs by {:.0f} W/m2 rms from what the "
                     "steps use, and thin sheets by kelvins at single times",
                     *middle, scene.time.step, missed.rms()),
         fmt::format("set time.step_s = {:g}, or use mean values over {:g} s as weather", *middle,
                     scene.time.step)}};
}

}  // namespace diurna
