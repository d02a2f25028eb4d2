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

/// It makes vapour pressure of the air's temperature, so it has no place in Forcing.
constexpr double usual_humidity = 0.5;
constexpr Column relative_humidity{"relative_humidity", 0.0, 1.1, nullptr, "humidity 0.5"};

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

/// Throws InputError for columns that no weather file has.
void check_header(const CsvTable& table, const std::filesystem::path& file) {
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
}

/// A row's cell, checked; `otherwise` where the column or the cell is not there.
double cell_or(const CsvTable& table, std::size_t row, const Column& column, double otherwise) {
    if (!table.has(column.name)) return otherwise;
    const std::size_t c = table.column(column.name);
    if (table.rows[row][c].empty()) return otherwise;
    return checked(table, row, c, column.least, column.most);
}

Forcing read_row(const CsvTable& table, std::size_t row, double elevation) {
    Forcing forcing;
    forcing.air.temperature = checked(table, row, table.column("air_temperature_K"), 1.0, 1000.0);
    forcing.air.pressure = standard_pressure(elevation);
    for (const Column& column : flux_and_state) {
        double& value = column.place(forcing);
        value = cell_or(table, row, column, value);
    }
    // An anemometer at rest may read a little less than nothing.
    forcing.wind_speed = std::max(0.0, forcing.wind_speed);
    const double humidity = cell_or(table, row, relative_humidity, usual_humidity);
    forcing.air.vapour_pressure = std::min(
        humidity * saturation_vapour_pressure(forcing.air.temperature), forcing.air.pressure);
    return forcing;
}

/// The instant of a row; `before` holds those of the rows above.
Instant read_stamp(const CsvTable& table, std::size_t row, const std::vector<Instant>& before) {
    const std::size_t time = table.column("time");
    const Instant stamp = parse_instant(table.rows[row][time], table.where(row, time));
    if (row > 0 && stamp <= before.back()) {
        throw InputError(
            table.where(row, time),
            fmt::format("{} does not come after the row before it", table.rows[row][time]));
    }
    return stamp;
}

/// One line of what a file does not tell and what stands for it; empty where nothing is missing.
std::string tell_absent(const CsvTable& table) {
    std::string absent;
    const auto say = [&](const std::string& what) {
        absent += (absent.empty() ? "" : ", ") + what;
    };
    if (!table.has(relative_humidity.name)) say(relative_humidity.modelled);
    for (const Column& column : flux_and_state) {
        if (column.modelled && !table.has(column.name)) say(column.modelled);
    }
    if (!table.has("shortwave_down_W_m2") && !table.has("direct_normal_W_m2") &&
        !table.has("plane_of_array_W_m2")) {
        say("clear-sky sun (Bird)");
    }
    return absent.empty() ? "" : "not measured, modelled: " + absent;
}

}  // namespace

namespace {

AirState on_line(const AirState& a, const AirState& b, double share) {
    return {.temperature = a.temperature + share * (b.temperature - a.temperature),
            .pressure = a.pressure + share * (b.pressure - a.pressure),
            .vapour_pressure = a.vapour_pressure + share * (b.vapour_pressure - a.vapour_pressure)};
}

/// The samples before and after an instant, and how far it is on the way.
struct Between {
    std::size_t before, after;
    double share;
};
Between place_of(const Weather& weather, Instant when) {
    const auto& instant = weather.instant;
    const auto next = std::upper_bound(instant.begin(), instant.end(), when);
    if (next == instant.begin()) return {0, 0, 0.0};
    const auto i = static_cast<std::size_t>(next - instant.begin());
    if (next == instant.end()) return {i - 1, i - 1, 0.0};
    return {i - 1, i,
            seconds_between(instant[i - 1], when) / seconds_between(instant[i - 1], instant[i])};
}

}  // namespace

Forcing between(const Forcing& a, const Forcing& b, double share) {
    const auto mix = [&](double Forcing::*member) {
        return a.*member + share * (b.*member - a.*member);
    };
    return {.air = on_line(a.air, b.air, share),
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

AirState Weather::air_at(Instant when) const {
    const Between place = place_of(*this, when);
    if (place.share == 0.0) return sample[place.before].air;
    return on_line(sample[place.before].air, sample[place.after].air, place.share);
}

Forcing Weather::at(Instant when) const {
    const Between place = place_of(*this, when);
    const Forcing &a = sample[place.before], &b = sample[place.after];
    Forcing now = place.share == 0.0 ? a : between(a, b, place.share);
    if (span_of(place.before) > 0.0 || span_of(place.after) > 0.0) {
        // A mean of rain is a sum that fell within its interval.
        const auto holds = [&](std::size_t i) {
            return std::abs(seconds_between(instant[i], when)) <= 0.5 * span_of(i);
        };
        now.rain_mm_h = holds(place.before) ? a.rain_mm_h : holds(place.after) ? b.rain_mm_h : 0.0;
    }
    return now;
}

void place_means(Stamp interval, Weather& weather) {
    std::vector<Instant>& instant = weather.instant;
    if (interval == Stamp::instant || instant.size() < 2) return;  // a lone row has no interval
    const std::vector<Instant> stamp = instant;
    std::vector<double> step;
    for (std::size_t i = 1; i < stamp.size(); ++i) {
        step.push_back(seconds_between(stamp[i - 1], stamp[i]));
    }
    std::vector<double> sorted = step;
    std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2),
                     sorted.end());
    const double usual = sorted[sorted.size() / 2];
    weather.span.resize(stamp.size());
    for (std::size_t i = 0; i < stamp.size(); ++i) {
        const bool end = interval == Stamp::end;
        // The interval of the first (last) row is as long as its neighbour's, and none reaches over
        // a gap.
        const std::size_t own =
            end ? std::max<std::size_t>(i, 1) - 1 : std::min(i, step.size() - 1);
        weather.span[i] = std::min(step[own], 1.001 * usual);
        instant[i] = later(stamp[i], (end ? -0.5 : 0.5) * weather.span[i]);
    }
}

Weather read_weather(const std::filesystem::path& file, const WeatherOptions& options) {
    const CsvTable table = read_csv(file);
    check_header(table, file);
    if (table.rows.empty()) throw InputError(file.string(), "holds no weather, only a header");
    std::vector<Instant> stamp;
    std::vector<Forcing> sample;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        stamp.push_back(read_stamp(table, row, stamp));
        sample.push_back(read_row(table, row, options.elevation));
    }
    Weather weather{.instant = std::move(stamp),
                    .sample = std::move(sample),
                    .wind_height = options.wind_height,
                    .air_height = options.air_height,
                    .note = tell_absent(table)};
    place_means(options.interval, weather);
    return weather;
}

}  // namespace diurna
