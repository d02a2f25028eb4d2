#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "materials/base/units.hpp"
#include "terrain/place/sun_path.hpp"
#include "thermal/weather/sky_series.hpp"
#include "thermal/weather/weather.hpp"

/// Sunlight by the minute, its means over hours, and what the program makes of them.
namespace diurna::testing {

/// A day of sunlight by the minute.
struct Minutes {
    Site site;
    Instant start;
    std::vector<double> direct, diffuse, global;  // [W m⁻²] at the middle of each minute
    AirState air{};
    Instant at(std::size_t i) const { return later(start, 60.0 * (double(i) + 0.5)); }
};

/// A cloudless day by a formula that is none of the program's: direct light after Meinel (0.7 to
/// the power of air mass^0.678, Kasten & Young 1989), diffuse 0.12 of the solar constant times
/// sin^0.7 of the elevation.
inline Minutes clear_day(double latitude_deg, const std::string& midnight_utc) {
    Minutes day{.site = {.latitude_deg = latitude_deg, .longitude_deg = 0.0},
                .start = parse_instant(midnight_utc),
                .direct = {},
                .diffuse = {},
                .global = {}};
    SunPath path(day.site);
    for (std::size_t i = 0; i < 1440; ++i) {
        const SunPosition sun = refracted(path.at(day.at(i)), 1013.25, 15.0);
        const double up = std::max(0.0, sun.elevation_deg), sine = std::sin(radians(up));
        const double mass = 1.0 / (sine + 0.50572 * std::pow(up + 6.07995, -1.6364));
        const double direct =
            up > 0.0 ? 1361.0 / std::pow(sun.distance_au, 2) * std::pow(0.7, std::pow(mass, 0.678))
                     : 0.0;
        day.direct.push_back(direct);
        day.diffuse.push_back(0.12 * 1361.0 * std::pow(sine, 0.7));
        day.global.push_back(direct * sine + day.diffuse.back());
    }
    return day;
}

struct Given {
    bool global, direct, diffuse;
};

/// The day's means over `minutes`, as a file that says so much of it would give them.
inline Weather means(const Minutes& day, int minutes, Given given) {
    Weather weather;
    for (int from = 0; from < 1440; from += minutes) {
        Forcing forcing{.air = day.air};
        const auto mean = [&](const std::vector<double>& of) {
            double sum = 0.0;
            for (int i = from; i < from + minutes; ++i) sum += of[std::size_t(i)];
            return sum / minutes;
        };
        if (given.global) forcing.shortwave_down = mean(day.global);
        if (given.direct) forcing.direct_normal = mean(day.direct);
        if (given.diffuse) forcing.diffuse = mean(day.diffuse);
        weather.sample.push_back(forcing);
        weather.instant.push_back(later(day.start, 60.0 * (from + 0.5 * minutes)));
        weather.span.push_back(60.0 * minutes);
    }
    return weather;
}

/// What comes of them, at the minutes' middles.
inline Minutes put_back(const Minutes& day, const Weather& weather) {
    Minutes got{.site = day.site, .start = day.start, .direct = {}, .diffuse = {}, .global = {}};
    const SkySeries sky(weather, day.site, day.site.height, {}, day.start,
                        later(day.start, 86400.0));
    SunPath path(day.site);
    for (std::size_t i = 0; i < day.direct.size(); ++i) {
        const SkyState now = sky.at(day.at(i), path.at(day.at(i)));
        got.direct.push_back(now.direct_normal);
        got.diffuse.push_back(now.diffuse_horizontal);
        got.global.push_back(now.global_horizontal());
    }
    return got;
}

/// Direct light on a wall facing an azimuth [W m⁻²].
inline std::vector<double> on_wall(const Minutes& day, double azimuth_deg) {
    std::vector<double> beam;
    SunPath path(day.site);
    for (std::size_t i = 0; i < day.direct.size(); ++i) {
        const SunPosition sun = refracted(path.at(day.at(i)), 1013.25, 15.0);
        const double cosine = sun_direction(sun).dot(direction(azimuth_deg, 0.0));
        beam.push_back(std::max(0.0, cosine) * day.direct[i]);
    }
    return beam;
}

struct Figures {
    double rms, largest, sum;  // [W m⁻²]; of the truth's largest; relative, of the day's global
};
inline Figures compare(const Minutes& truth, const Minutes& got, double azimuth_deg) {
    const std::vector<double> a = on_wall(truth, azimuth_deg), b = on_wall(got, azimuth_deg);
    double square = 0.0, sum = 0.0, whole = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        square += (b[i] - a[i]) * (b[i] - a[i]);
        sum += got.global[i] - truth.global[i];
        whole += truth.global[i];
    }
    return {std::sqrt(square / double(a.size())),
            *std::max_element(b.begin(), b.end()) /
                std::max(1.0, *std::max_element(a.begin(), a.end())),
            sum / whole};
}

}  // namespace diurna::testing
