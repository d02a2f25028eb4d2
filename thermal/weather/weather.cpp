#include "thermal/weather/weather.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"

namespace diurna {

namespace {

struct Column {
    const char* name;
    double least, most;
    double& (*place)(Forcing&);
    const char* modelled;  // what stands in for it, or null if nothing is said
};

// Range: what no thermometer, anemometer or radiometer on the ground has ever read.
const std::array<Column, 10> flux_and_state{{
    {"wind_speed_m_s", -0.5, 120.0, [](Forcing& f) -> double& { return f.wind_speed; },
     "wind 1 m/s"},
    {"rain_mm_h", 0.0, 2000.0, [](Forcing& f) -> double& { return f.rain_mm_h; }, nullptr},
    {"cloud_fraction", 0.0, 1.0, [](Forcing& f) -> double& { return f.cloud_fraction; }, nullptr},
    {"shortwave_down_W_m2", -100.0, 2500.0, [](Forcing& f) -> double& { return f.shortwave_down; },
     nullptr},
    {"direct_normal_W_m2", -100.0, 2500.0, [](Forcing& f) -> double& { return f.direct_normal; },
     nullptr},
    {"diffuse_W_m2", -100.0, 2500.0, [](Forcing& f) -> double& { return f.diffuse; }, nullptr},
    {"shortwave_up_W_m2", -100.0, 2500.0, [](Forcing& f) -> double& { return f.shortwave_up; },
     nullptr},
    {"plane_of_array_W_m2", -100.0, 3000.0, [](Forcing& f) -> double& { return f.plane_of_array; },
     nullptr},
    {"longwave_down_W_m2", 0.0, 1000.0, [](Forcing& f) -> double& { return f.longwave_down; },
     "longwave from air and cloud"},
    {"pressure_Pa", 100.0, 120000.0, [](Forcing& f) -> double& { return f.air.pressure; },
     "pressure of the standard atmosphere"},
}};

double checked(const CsvTable& table, std::size_t row, std::size_t column, double least,
               double most) {
    const double value = table.number(row, column);
    if (value < least || value > most) {
        throw InputError(table.where(row, column),
                         fmt::format("found {}; {} lies between {} and {}", value,
                                     table.header[column], least, most));
    }
    return value;
}

double between(double a, double b, double share) { return a + share * (b - a); }

}  // namespace

Forcing Weather::at(Instant when) const {
    const auto after = std::upper_bound(instant.begin(), instant.end(), when);
    if (after == instant.begin()) return sample.front();
    if (after == instant.end()) return sample.back();
    const auto i = static_cast<std::size_t>(after - instant.begin());
    const double share =
        seconds_between(instant[i - 1], when) / seconds_between(instant[i - 1], instant[i]);
    const Forcing &a = sample[i - 1], &b = sample[i];
    if (share == 0.0) return a;
    const auto mix = [&](double Forcing::*member) { return between(a.*member, b.*member, share); };
    return {
        .air = {.temperature = between(a.air.temperature, b.air.temperature, share),
                .pressure = between(a.air.pressure, b.air.pressure, share),
                .vapour_pressure = between(a.air.vapour_pressure, b.air.vapour_pressure, share)},
        .wind_speed = mix(&Forcing::wind_speed),
        .rain_mm_h = mix(&Forcing::rain_mm_h),
        .cloud_fraction = mix(&Forcing::cloud_fraction),
        .shortwave_down = mix(&Forcing::shortwave_down),
        .direct_normal = mix(&Forcing::direct_normal),
        .diffuse = mix(&Forcing::diffuse),
        .shortwave_up = mix(&Forcing::shortwave_up),
        .plane_of_array = mix(&Forcing::plane_of_array),
        .longwave_down = mix(&Forcing::longwave_down)};
}

Weather read_weather(const std::filesystem::path& file, const WeatherOptions& options) {
    const CsvTable table = read_csv(file);
    std::vector<std::string> known{"time", "air_temperature_K", "relative_humidity"};
    for (const Column& column : flux_and_state) known.emplace_back(column.name);
    std::vector<Mistake> mistakes;
    for (const std::string& name : table.header) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            mistakes.push_back({fmt::format("{}: {}", file.string(), name),
                                "is no column of a weather file", did_you_mean(name, known)});
        }
    }
    if (!mistakes.empty()) throw InputError(mistakes);
    if (table.rows.empty()) throw InputError(file.string(), "holds no weather, only a header");

    const std::size_t time = table.column("time"), air = table.column("air_temperature_K");
    Weather weather{.instant = {},
                    .sample = {},
                    .wind_height = options.wind_height,
                    .air_height = options.air_height,
                    .note = ""};
    std::vector<Instant> stamp;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        stamp.push_back(parse_instant(table.rows[row][time], table.where(row, time)));
        if (row > 0 && stamp[row] <= stamp[row - 1]) {
            throw InputError(
                table.where(row, time),
                fmt::format("{} does not come after the row before it", table.rows[row][time]));
        }
        const auto empty = [&](std::size_t column) { return table.rows[row][column].empty(); };
        Forcing forcing;
        forcing.air.temperature = checked(table, row, air, 1.0, 1000.0);
        forcing.air.pressure = standard_pressure(options.elevation);
        for (const Column& column : flux_and_state) {
            if (!table.has(column.name)) continue;
            const std::size_t c = table.column(column.name);
            if (!empty(c)) {
                column.place(forcing) = checked(table, row, c, column.least, column.most);
            }
        }
        // An anemometer at rest may read a little less than nothing.
        forcing.wind_speed = std::max(0.0, forcing.wind_speed);
        double humidity = 0.5;
        if (table.has("relative_humidity")) {
            const std::size_t c = table.column("relative_humidity");
            if (!empty(c)) humidity = checked(table, row, c, 0.0, 1.1);
        }
        forcing.air.vapour_pressure = std::min(
            humidity * saturation_vapour_pressure(forcing.air.temperature), forcing.air.pressure);
        weather.sample.push_back(forcing);
    }

    // A mean stands for the middle of its interval; a lone row has no interval.
    weather.instant = stamp;
    if (options.interval != Stamp::instant && stamp.size() > 1) {
        for (std::size_t i = 0; i < stamp.size(); ++i) {
            const bool end = options.interval == Stamp::end;
            // The interval of the first (last) row is as long as its neighbour's.
            const std::size_t upper =
                end ? std::max<std::size_t>(i, 1) : std::min(i + 1, stamp.size() - 1);
            const auto half = (stamp[upper] - stamp[upper - 1]) / 2;
            weather.instant[i] = end ? stamp[i] - half : stamp[i] + half;
        }
    }

    std::string absent;
    const auto say = [&](const std::string& what) {
        absent += (absent.empty() ? "" : ", ") + what;
    };
    if (!table.has("relative_humidity")) say("humidity 0.5");
    for (const Column& column : flux_and_state) {
        if (column.modelled && !table.has(column.name)) say(column.modelled);
    }
    if (!table.has("shortwave_down_W_m2") && !table.has("direct_normal_W_m2") &&
        !table.has("plane_of_array_W_m2")) {
        say("clear-sky sun (Bird)");
    }
    if (!absent.empty()) weather.note = "not measured, modelled: " + absent;
    return weather;
}

Weather constant_weather(const Forcing& forcing, double wind_height, double air_height) {
    return {.instant = {Instant{}},
            .sample = {forcing},
            .wind_height = wind_height,
            .air_height = air_height,
            .note = ""};
}

}  // namespace diurna
