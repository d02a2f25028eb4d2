#include "scenes/world/air.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/atmosphere/ground_fluxes.hpp"
#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "scenes/world/stepping.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/weather/apparent_sun.hpp"
#include "thermal/weather/cropped_weather.hpp"
#include "thermal/weather/sky_series.hpp"

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

/// The series at every step of the heat balance, its unmeasured radiation from the atmosphere.
Weather driven_by_air(const Scene& scene, const World& world, const SkySeries& series) {
    const Weather& weather = series.weather();
    Weather driven = weather;
    driven.span.clear();
    driven.note +=
        (weather.note.empty() ? "" : "; but ") +
        std::string("sun and longwave that were not measured come from the scene's atmosphere");
    driven.instant = driven_instants(scene, weather);
    driven.sample.resize(driven.instant.size());
    const double ground_km = weather.height / 1000.0;
    const HeightSpan ground = heights_of_surfaces(world);
    const auto fill = [&](std::size_t i) {
        const Instant instant = driven.instant[i];
        const SunPosition sun = sun_position(world.site, instant);
        const SunPosition seen = apparent_sun(sun, weather.air_at(instant), weather.height);
        const GroundFluxes flux = ground_fluxes(
            atmosphere_over(scene, world, weather, ground, instant),
            {.zenith_deg = 90.0 - seen.elevation_deg, .distance_au = seen.distance_au}, ground_km);
        Forcing forcing = weather.at(instant);
        if (std::isnan(forcing.shortwave_down) && std::isnan(forcing.direct_normal)) {
            forcing.direct_normal = flux.sun_direct;
            forcing.diffuse = flux.sun_diffuse;
        } else {
            const SkyState sky = series.at(instant, sun);
            forcing.direct_normal = sky.direct_normal;
            forcing.diffuse = sky.diffuse_horizontal;
            forcing.shortwave_down = sky.global_horizontal();
            forcing.shortwave_up = sky.albedo * forcing.shortwave_down;
        }
        if (std::isnan(forcing.longwave_down)) forcing.longwave_down = flux.thermal;
        driven.sample[i] = forcing;
    };
    for_each_index(driven.instant.size(), fill, 4);
    return driven;
}

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

Atmosphere atmosphere_at(const Scene& scene, const World& world, const Weather& weather,
                         Instant instant) {
    return atmosphere_over(scene, world, weather, heights_of_surfaces(world), instant);
}

Atmosphere atmosphere_over(const Scene& scene, const World& world, const Weather& weather,
                           const HeightSpan& ground, Instant instant) {
    const AirInput& air = scene.air;
    if (air.vacuum) return Vacuum{};
    const Forcing forcing = weather.at(instant);
    const double ground_km = world.sea_level_height / 1000.0;
    Profile profile =
        profile_over(air.sounding ? *air.sounding : afgl_profile(air.profile),
                     air_by_height(scene, weather), forcing.air, ground.low, ground.high);
    if (air.table) return Tabulated{air.table, std::make_shared<const Profile>(std::move(profile))};
    BandModel model;
    model.profile = std::move(profile);
    model.aerosol = air.aerosol;
    model.visibility_km = air.visibility_km;
    model.co2_ppm = air.co2_ppm;
    model.ground_km = std::max(0.0, ground_km);
    model.rain_mm_h = forcing.rain_mm_h;
    if (!std::isnan(forcing.cloud_fraction)) model.cloud.fraction = forcing.cloud_fraction;
    model.cloud.base_km = ground_km + air.cloud_base_km;
    return model;
}

void check_table(const Scene& scene, const World& world, std::span<const Observer> observers) {
    if (!scene.air.table) return;
    const TableSpan span = scene.air.table->span;
    const std::string where = scene.file.string() + ": atmosphere.table";
    constexpr double slack = 1e-3;  // [km]
    const auto inside = [&](const char* what, double low, double high, double least, double most) {
        if (low >= least - slack && high <= most + slack) return;
        throw InputError(where, fmt::format("{} from {:.3f} to {:.3f} km, the table has {:.3f} to "
                                            "{:.3f} km",
                                            what, low, high, least, most));
    };
    const double sea_km = world.sea_level_height / 1000.0;
    const HeightSpan ground = heights_of_surfaces(world);
    const double low = std::min(sea_km, 1e-3 * ground.low);
    const double high = std::max(sea_km, 1e-3 * ground.high);
    double farthest = 0.0;
    inside("surfaces lie", low, high, span.least_to_km, span.most_to_km);
    inside("surfaces that see the sky lie", low, high, span.least_sky_km, span.most_sky_km);
    for (const Observer& observer : observers) {
        const double eye_km = 1e-3 * height_above_sea(world, observer.position);
        inside("observers look", eye_km, eye_km, span.least_from_km, span.most_from_km);
        inside("observers see the sky", eye_km, eye_km, span.least_sky_km, span.most_sky_km);
        for (const Eigen::Vector3f& vertex : world.facets.vertex) {
            farthest = std::max(farthest, (vertex.cast<double>() - observer.position).norm());
        }
        // Beyond the mesh the plain goes on to its horizon.
        const double above_km = std::max(0.0, eye_km - sea_km);
        farthest = std::max(
            farthest, 1e3 * std::sqrt(above_km * (2.0 * (earth_radius_km + sea_km) + above_km)));
    }
    inside("lines of sight, to the plain's horizon, go", 0.0, 1e-3 * farthest, 0.0,
           span.most_range_km);
}

std::vector<std::string> table_notes(const Scene& scene) {
    if (!scene.air.table) return {};
    return {
        fmt::format("the air is a table of {} paths of {}, the same at every instant: weather's "
                    "rain and cloud and scattered sunlight are not in the pictures' air; error "
                    "of interpolation between its paths not measured",
                    scene.air.table->span.paths, scene.air.table_file.filename().string())};
}

Weather scene_weather(const Scene& scene, const World& world) {
    WeatherOptions options = scene.weather.options;
    options.elevation = world.sea_level_height;
    options.site = world.site;
    options.asked = used_span(scene.time);
    Weather weather = cropped(read_weather(scene.weather.files, options),
                              later(scene.time.start, -options.asked.before),
                              later(scene.time.end(), options.asked.behind));
    const double height = weather.height;
    const SkySeries series(std::move(weather), world.site, height, scene.sky, scene.time.start,
                           scene.time.end());
    return scene.air.drives_heat ? driven_by_air(scene, world, series) : series.weather();
}

}  // namespace diurna
