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

/// The instants that rows stand for: a mean for the middle of its interval. The interval of the
/// first (last) row is as long as its neighbour's; a lone row has none.
std::vector<Instant> place_stamps(const std::vector<Instant>& stamp, Stamp interval) {
    std::vector<Instant> placed = stamp;
    if (interval == Stamp::instant || stamp.size() < 2) return placed;
    for (std::size_t i = 0; i < stamp.size(); ++i) {
        const bool end = interval == Stamp::end;
        const std::size_t upper =
            end ? std::max<std::size_t>(i, 1) : std::min(i + 1, stamp.size() - 1);
        const auto half = (stamp[upper] - stamp[upper - 1]) / 2;
        placed[i] = end ? stamp[i] - half : stamp[i] + half;
    }
    return placed;
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

Forcing between(const Forcing& a, const Forcing& b, double share) {
    const auto on_line = [&](double from, double to) { return from + share * (to - from); };
    const auto mix = [&](double Forcing::*member) { return on_line(a.*member, b.*member); };
    return {.air = {.temperature = on_line(a.air.temperature, b.air.temperature),
                    .pressure = on_line(a.air.pressure, b.air.pressure),
                    .vapour_pressure = on_line(a.air.vapour_pressure, b.air.vapour_pressure)},
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

Forcing Weather::at(Instant when) const {
    const auto after = std::upper_bound(instant.begin(), instant.end(), when);
    if (after == instant.begin()) return sample.front();
    if (after == instant.end()) return sample.back();
    const auto i = static_cast<std::size_t>(after - instant.begin());
    const double share =
        seconds_between(instant[i - 1], when) / seconds_between(instant[i - 1], instant[i]);
    return share == 0.0 ? sample[i - 1] : between(sample[i - 1], sample[i], share);
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
    return {.instant = place_stamps(stamp, options.interval),
            .sample = std::move(sample),
            .wind_height = options.wind_height,
            .air_height = options.air_height,
            .note = tell_absent(table)};
}

}  // namespace diurna
