#include "scenes/job/world/driven_weather.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "materials/atmosphere/cloud_modification.hpp"
#include "materials/base/units.hpp"
#include "scenes/job/world/air.hpp"
#include "scenes/job/world/air_light.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/stepping.hpp"
#include "terrain/place/sun_path.hpp"
#include "thermal/weather/apparent_sun.hpp"

namespace diurna {

namespace {

/// Every step of the span, and of the days before it and the first day that its start may take.
std::vector<Instant> driven_instants(const Scene& scene, const Weather& weather) {
    constexpr double day = 86400.0;
    const TimeInput& time = scene.time;
    const double before = day * double(std::max(1, time.days_before));
    const double known = seconds_between(weather.instant.front(), time.start);
    const double days = std::floor(std::clamp(known, 0.0, before) / day);
    const Instant from = later(time.start, -day * days);
    const Instant to = std::max(time.end(), later(time.start, day));
    return step_instants({.start = from, .duration = seconds_between(from, to), .step = time.step});
}

bool sun_measured(const Forcing& f) {
    return !std::isnan(f.shortwave_down) ||
           (!std::isnan(f.direct_normal) && !std::isnan(f.diffuse));
}

/// The rows that matter between two instants, those that bracket them included.
std::pair<std::size_t, std::size_t> rows_within(const Weather& weather, Instant from, Instant to) {
    const auto& at = weather.instant;
    const auto first = std::upper_bound(at.begin(), at.end(), from) - at.begin();
    const auto last = std::lower_bound(at.begin(), at.end(), to) - at.begin();
    return {static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, first - 1)),
            std::min(at.size(), static_cast<std::size_t>(last) + 1)};
}

double cover_of(const Forcing& forcing) {
    return std::isnan(forcing.cloud_fraction) ? 0.0 : forcing.cloud_fraction;
}

std::vector<AirMoment> moments_of(const World& world, const Weather& weather,
                                  const std::vector<Instant>& instants) {
    SunPath path(world.site);
    std::vector<AirMoment> moments;
    for (const Instant instant : instants) {
        const AirState air = weather.air_at(instant);
        moments.push_back({air, apparent_sun(path.at(instant), air, weather.height)});
    }
    return moments;
}

/// The scene's air without cloud over its station, where only the air at the ground differs.
AirLight own_light(const Scene& scene, const World& world, const Weather& weather,
                   const std::vector<AirMoment>& moments, bool sunlight, bool longwave) {
    const HeightSpan ground = heights_of_ground(world);
    const auto air_of = [&](const AirState& air) {
        Forcing forcing;
        forcing.air = air;
        return std::get<BandModel>(atmosphere_of(scene, world, weather, ground, forcing));
    };
    const bool clouds = std::any_of(weather.sample.begin(), weather.sample.end(),
                                    [](const Forcing& f) { return f.cloud_fraction > 0.0; });
    return AirLight(air_of, weather.height / 1000.0, moments,
                    {.sunlight = sunlight, .longwave = longwave, .overcast = clouds});
}

double longwave_of(const CloudlessLight& light, double cover) {
    return std::lerp(light.longwave, light.longwave_overcast, cover);
}

/// Sunlight that was not measured, under the cover of the row.
void take_own_sunlight(const CloudlessLight& light, const SunPosition& sun, Forcing& forcing) {
    const double sine = std::max(0.0, std::sin(radians(sun.elevation_deg)));
    const CloudEffect left = kasten_czeplak(cover_of(forcing));
    const double global = left.global * (light.direct_normal * sine + light.diffuse);
    const double beam = left.beam * light.direct_normal;
    if (std::isnan(forcing.direct_normal)) forcing.direct_normal = beam;
    if (std::isnan(forcing.diffuse)) forcing.diffuse = std::max(0.0, global - beam * sine);
}

/// Longwave into the rows that matter.
Weather with_longwave(const Scene& scene, const World& world, Weather weather, Instant from,
                      Instant to) {
    const auto [first, last] = rows_within(weather, from, to);
    const std::vector<Instant> rows(weather.instant.begin() + std::ptrdiff_t(first),
                                    weather.instant.begin() + std::ptrdiff_t(last));
    const std::vector<AirMoment> moments = moments_of(world, weather, rows);
    const AirLight light = own_light(scene, world, weather, moments, false, true);
    for (std::size_t i = first; i < last; ++i) {
        Forcing& forcing = weather.sample[i];
        if (!std::isnan(forcing.longwave_down)) continue;
        forcing.longwave_down = longwave_of(light.at(moments[i - first]), cover_of(forcing));
    }
    return weather;
}

}  // namespace

Weather driven_weather(const Scene& scene, const World& world, const SkySeries& series) {
    const Weather& weather = series.weather();
    const std::vector<Instant> instants = driven_instants(scene, weather);
    const auto [first, last] = rows_within(weather, instants.front(), instants.back());
    bool sunlight = true, longwave = true, any_sunlight = false, any_longwave = false;
    for (std::size_t i = first; i < last; ++i) {
        const bool sun = sun_measured(weather.sample[i]);
        const bool heat = !std::isnan(weather.sample[i].longwave_down);
        sunlight = sunlight && sun;
        longwave = longwave && heat;
        any_sunlight = any_sunlight || sun;
        any_longwave = any_longwave || heat;
    }
    if (sunlight && longwave) return weather;
    Weather driven = weather;
    const bool part = (any_sunlight && !sunlight) || (any_longwave && !longwave);
    driven.note += std::string(weather.note.empty() ? "" : "; ") +
                   (sunlight   ? "longwave"
                    : longwave ? "sunlight"
                               : "sunlight and longwave") +
                   (part ? " where not measured" : "") + " from the scene's atmosphere";
    if (sunlight) {
        return with_longwave(scene, world, std::move(driven), instants.front(), instants.back());
    }
    driven.span.clear();
    driven.instant = instants;
    driven.sample.clear();
    const std::vector<AirMoment> moments = moments_of(world, weather, instants);
    const AirLight light = own_light(scene, world, weather, moments, true, !longwave);
    for (std::size_t i = 0; i < instants.size(); ++i) {
        Forcing forcing = weather.at(instants[i]);
        const CloudlessLight own = light.at(moments[i]);
        forcing.cloud_fraction = cover_of(forcing);
        if (!std::isnan(forcing.shortwave_down) || !std::isnan(forcing.direct_normal) ||
            !std::isnan(forcing.diffuse)) {
            const SkyState sky = series.at(instants[i], sun_position(world.site, instants[i]));
            const bool both = sun_measured(forcing);
            const bool beam = both || !std::isnan(forcing.direct_normal);
            const bool diffuse = both || !std::isnan(forcing.diffuse);
            forcing.direct_normal = beam ? sky.direct_normal : not_measured;
            forcing.diffuse = diffuse ? sky.diffuse_horizontal : not_measured;
            if (!std::isnan(forcing.shortwave_down)) {
                forcing.shortwave_down = sky.global_horizontal();
                forcing.shortwave_up = sky.albedo * forcing.shortwave_down;
            }
        }
        take_own_sunlight(own, moments[i].sun, forcing);
        if (std::isnan(forcing.longwave_down)) {
            forcing.longwave_down = longwave_of(own, forcing.cloud_fraction);
        }
        driven.sample.push_back(forcing);
    }
    return driven;
}

}  // namespace diurna
