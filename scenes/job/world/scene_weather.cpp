#include "scenes/job/world/scene_weather.hpp"

#include <algorithm>
#include <utility>

#include "scenes/job/world/air_spread.hpp"
#include "scenes/job/world/driven_weather.hpp"
#include "scenes/job/world/light_at_heights.hpp"
#include "scenes/job/world/upper_air.hpp"
#include "thermal/weather/cropped_weather.hpp"
#include "thermal/weather/sky_series.hpp"

namespace diurna {

namespace {

/// The span, and what its start uses of the days before it and of the first day if that is longer.
AskedSpan used_span(const TimeInput& time) {
    constexpr double day = 86400.0;
    AskedSpan asked{.begin = time.start, .end = time.end()};
    if (time.spin_up == SpanStart::state || time.spin_up == SpanStart::steady) return asked;
    const bool weather = time.spin_up != SpanStart::periodic;
    asked.before = day * double(weather ? time.days_before : 1);
    asked.behind = std::max(0.0, day - time.duration);
    return asked;
}

}  // namespace

Weather measured_weather(const Scene& scene, const World& world) {
    WeatherOptions options = scene.weather.options;
    options.elevation = world.sea_level_height;
    options.site = world.site;
    options.asked = used_span(scene.time);
    const Instant from = later(scene.time.start, -options.asked.before);
    const Instant to = later(scene.time.end(), options.asked.behind);
    Weather weather = cropped(read_weather(scene.weather.files, options), from, to);
    take_upper_air(scene, world.site.longitude_deg, weather);
    return weather;
}

Weather scene_weather(const Scene& scene, const World& world, Weather measured) {
    const double height = measured.height;
    const SkySeries series(std::move(measured), world.site, height, scene.sky, scene.time.start,
                           scene.time.end());
    if (!scene.air.drives_heat) {
        Weather weather = series.weather();
        weather.by_height = light_at_heights(scene, world, weather, weather);
        return weather;
    }
    Weather driven = driven_weather(scene, world, series);
    driven.spreads = air_spread(scene, world, driven);
    driven.by_height = light_at_heights(scene, world, driven, series.weather());
    return driven;
}

Weather scene_weather(const Scene& scene, const World& world) {
    return scene_weather(scene, world, measured_weather(scene, world));
}

}  // namespace diurna
