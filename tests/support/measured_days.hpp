#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "materials/air/moist_air.hpp"
#include "materials/base/units.hpp"
#include "thermal/point/point_job.hpp"

/// Readers of the measured surface temperatures (each data folder's SOURCE.md says what its columns
/// are): weather in, skin temperature beside it.
namespace measured {

using namespace diurna;

struct Series {
    Site site;
    Weather weather;
    std::vector<Instant> when;
    std::vector<double> skin;        // [K]
    std::vector<SoilPoint> profile;  // ground at the start, where it was measured
};

/// A facet of a surface through the whole series, its weather given, nothing fitted.
inline PointJob job_of(const Series& series, const ThermalSurface& surface, double cadence) {
    PointJob job;
    job.site = series.site;
    job.elevation = series.site.height;
    job.weather = series.weather;
    job.surface = surface;
    job.start = series.weather.instant.front();
    job.end = series.weather.instant.back();
    job.step = cadence;
    job.initial_profile = series.profile;
    if (!series.profile.empty()) job.spin_up = SpinUp::none;
    return job;
}

inline double skin_from_longwave(double up, double down, double emissivity) {
    return std::pow((up - (1.0 - emissivity) * down) / (emissivity * stefan_boltzmann), 0.25);
}

inline std::vector<std::vector<double>> rows_of(const std::filesystem::path& file, int header,
                                                char separator = ' ') {
    std::ifstream in(file);
    std::string line;
    for (int i = 0; i < header; ++i) std::getline(in, line);
    std::vector<std::vector<double>> rows;
    while (std::getline(in, line)) {
        if (separator != ' ') std::replace(line.begin(), line.end(), separator, ' ');
        std::istringstream words(line);
        std::vector<double> row;
        for (double x; words >> x;) row.push_back(x);
        if (!row.empty()) rows.push_back(row);
    }
    return rows;
}

/// 15 September 2022 follows from the noons' zenith angles: declination 2.4° at the first.
inline Series woodhouse(const std::filesystem::path& folder) {
    Series s{.site = {.latitude_deg = 35.4, .longitude_deg = -111.3, .height = 1600.0},
             .weather = {},
             .when = {},
             .skin = {},
             .profile = {}};
    s.weather.wind_height = s.weather.air_height = 3.0;
    const Instant start = parse_instant("2022-09-15T16:58:00-07:00");
    const auto rows = rows_of(folder / "wh2022_days1-2.csv", 1, ',');
    for (const auto& r : rows) {
        Forcing f;
        f.air = {.temperature = r[1] + zero_celsius, .pressure = r[3], .vapour_pressure = 0.0};
        f.air.vapour_pressure = r[2] * saturation_vapour_pressure(f.air.temperature);
        f.wind_speed = r[4];
        f.shortwave_down = std::max(0.0, r[5]);
        f.shortwave_up = std::max(0.0, r[6]);
        f.longwave_down = r[7];
        f.diffuse = std::clamp(r[8], 0.0, 1.0) * f.shortwave_down;
        const Instant when = later(start, 60.0 * r[0]);
        s.weather.instant.push_back(when);
        s.weather.sample.push_back(f);
        if (r[12] == 1.0) {
            s.when.push_back(when);
            s.skin.push_back(r[11] + zero_celsius);
        }
    }
    const double depth[]{0.0, 0.05, 0.10, 0.20, 0.30, 0.40, 0.50};
    for (int i = 0; i < 7; ++i) {
        s.profile.push_back({depth[i], rows.front()[std::size_t(13 + i)] + zero_celsius});
    }
    return s;
}

inline Series alamosa(const std::filesystem::path& folder) {
    Series s{.site = {.latitude_deg = 37.70, .longitude_deg = -105.92, .height = 2317.0},
             .weather = {},
             .when = {},
             .skin = {},
             .profile = {}};
    s.weather.wind_height = s.weather.air_height = 10.0;
    for (const auto& r : rows_of(folder / "slv16001.dat", 2)) {
        const auto value = [&](int i) { return r[std::size_t(8 + 2 * i)]; };
        if (value(15) < -900.0 || value(16) < -900.0) continue;
        Forcing f;
        f.air = {.temperature = value(15) + zero_celsius,
                 .pressure = value(19) * 100.0,
                 .vapour_pressure = 0.0};
        f.air.vapour_pressure = value(16) / 100.0 * saturation_vapour_pressure(f.air.temperature);
        f.wind_speed = std::max(0.0, value(17));
        f.shortwave_down = std::max(0.0, value(0));
        f.shortwave_up = std::max(0.0, value(1));
        f.direct_normal = std::max(0.0, value(2));
        f.diffuse = std::max(0.0, value(3));
        f.longwave_down = value(4);
        const Instant when = later(parse_instant("2016-01-01T00:00:00Z"),
                                   3600.0 * r[4] + 60.0 * r[5] + 86400.0 * (r[1] - 1.0));
        s.weather.instant.push_back(when);
        s.weather.sample.push_back(f);
        s.when.push_back(when);
        s.skin.push_back(skin_from_longwave(value(7), value(4), 0.97));
    }
    return s;
}

/// Stamps end their half hours. The infrared thermometer counts the ground as black; with an
/// emissivity of 0.98 the sky in it makes it read 0.3 to 0.8 K low, which is taken back.
inline Series bondville_1998(const std::filesystem::path& folder) {
    Series s{.site = {.latitude_deg = 40.01, .longitude_deg = -88.37, .height = 219.0},
             .weather = {},
             .when = {},
             .skin = {},
             .profile = {}};
    s.weather.wind_height = 10.0;
    s.weather.air_height = 3.0;
    const auto known = [](double x) { return x > -6000.0; };
    for (const auto& r : rows_of(folder / "jan-jul.dat", 0)) {
        const int clock = static_cast<int>(r[1]);
        const Instant stamp =
            later(parse_instant("1998-01-01T00:00:00-06:00"),
                  86400.0 * (r[0] - 1.0) + 3600.0 * (clock / 100) + 60.0 * (clock % 100));
        if (!known(r[2]) || !known(r[4]) || !known(r[5]) || !known(r[6])) continue;
        const Instant middle = later(stamp, -900.0);
        if (!s.weather.instant.empty() && middle <= s.weather.instant.back()) continue;
        Forcing f;
        f.air = {
            .temperature = r[4] + zero_celsius, .pressure = r[6] * 100.0, .vapour_pressure = 0.0};
        f.air.vapour_pressure =
            std::min(1.0, r[5] / 100.0) * saturation_vapour_pressure(f.air.temperature);
        f.wind_speed = std::max(0.0, r[2]);
        if (known(r[7])) f.shortwave_down = std::max(0.0, r[7]);
        if (known(r[12])) f.rain_mm_h = std::max(0.0, r[12]) * 25.4 * 2.0;
        if (known(r[29])) f.longwave_down = r[29];
        s.weather.instant.push_back(middle);
        s.weather.sample.push_back(f);
        if (known(r[14]) && r[14] != 0.0 && known(r[29])) {
            s.when.push_back(middle);
            s.skin.push_back(
                skin_from_longwave(stefan_boltzmann * power4(r[14] + zero_celsius), r[29], 0.98));
        }
    }
    const auto first = rows_of(folder / "jan-jul.dat", 0).front();
    const double depth[]{0.02, 0.04, 0.08, 0.16, 0.32, 0.64};
    for (int i = 0; i < 6; ++i) {
        s.profile.push_back({depth[i], first[std::size_t(15 + i)] + zero_celsius});
    }
    return s;
}

inline Series bondville_1995(const std::filesystem::path& folder) {
    Series s{.site = {.latitude_deg = 40.05, .longitude_deg = -88.37, .height = 230.0},
             .weather = {},
             .when = {},
             .skin = {},
             .profile = {}};
    s.weather.wind_height = s.weather.air_height = 10.0;
    for (const auto& r : rows_of(folder / "bon_19950510.qdat", 1)) {
        if (r[9] < 200.0 || r[10] < 0.0 || r[7] < 0.0 || r[8] < 0.0) continue;
        Forcing f;
        f.air = {.temperature = r[9], .pressure = standard_pressure(230.0), .vapour_pressure = 0.0};
        f.air.vapour_pressure = r[10] / 100.0 * saturation_vapour_pressure(r[9]);
        f.wind_speed = std::max(0.0, r[44]);
        if (r[2] > -900.0) f.shortwave_down = std::max(0.0, r[2]);
        if (r[6] > -900.0) f.shortwave_up = std::max(0.0, r[6]);
        f.longwave_down = r[7];
        const int clock = static_cast<int>(r[1]);
        const Instant when = later(parse_instant("1995-05-10T00:00:00Z"),
                                   3600.0 * (clock / 100) + 60.0 * (clock % 100));
        s.weather.instant.push_back(when);
        s.weather.sample.push_back(f);
        s.when.push_back(when);
        s.skin.push_back(skin_from_longwave(r[8], r[7], 0.98));
    }
    return s;
}

/// Snow covers the plot from the fifth day on; what the thermometer says below −35 °C under a clear
/// sky is doubted by its source and skipped.
///
/// sun_in_sky  share of the sun that the pyrgeometer counted as sky until 10 December 1995. On the
///             clear days before (steady nights around them) its longwave rises
///             at 10-14 h by 0.09 to 0.15 of the global sun over what the nights' share of σT⁴ and
///             the air's temperature say (190 W/m² by night, 277 at noon under air of 19 %
///             humidity), on those after by 0.00 ± 0.02
inline Series weissfluhjoch(const std::filesystem::path& folder, double sun_in_sky) {
    Series s{.site = {.latitude_deg = 46.831, .longitude_deg = 9.810, .height = 2540.0},
             .weather = {},
             .when = {},
             .skin = {},
             .profile = {}};
    s.weather.wind_height = 5.0;
    s.weather.air_height = 5.0;
    std::ifstream in(folder / "MST96_to_january.smet");
    std::string line;
    while (std::getline(in, line) && line != "[DATA]") {
    }
    while (std::getline(in, line)) {
        std::istringstream words(line);
        std::string stamp;
        std::vector<double> v;
        words >> stamp;
        for (double x; words >> x;) v.push_back(x);
        if (v.size() < 11 || v[0] < 0.0 || v[1] < 0.0 || v[5] < 0.0) continue;
        const Instant end = parse_instant(stamp + ":00+01:00");
        if (end < parse_instant("1995-11-05T00:00:00+01:00")) continue;
        Forcing f;
        f.air = {.temperature = v[0],
                 .pressure = standard_pressure(2540.0),
                 .vapour_pressure = v[1] * saturation_vapour_pressure(v[0])};
        f.wind_speed = std::max(0.0, v[5]);
        if (v[7] > -900.0) f.shortwave_up = std::max(0.0, v[7]);
        if (v[8] > -900.0) f.shortwave_down = std::max(0.0, v[8]);
        if (v[9] > 0.0) f.longwave_down = v[9];
        if (end < parse_instant("1995-12-11T00:00:00+01:00")) {
            f.longwave_down -= sun_in_sky * std::max(0.0, v[8]);
        }
        f.rain_mm_h = std::max(0.0, v[10]) * 2.0;
        const Instant middle = later(end, -900.0);
        s.weather.instant.push_back(middle);
        s.weather.sample.push_back(f);
        if (v[3] > 238.15) {
            s.when.push_back(middle);
            s.skin.push_back(v[3]);
        }
    }
    return s;
}

}  // namespace measured
