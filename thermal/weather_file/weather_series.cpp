#include "thermal/weather_file/weather_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "materials/air/moist_air.hpp"

namespace diurna {

namespace {

constexpr double usual_humidity = 0.5;

/// How long the interval is that ends (or starts) at a row's stamp: up to its neighbour, but no
/// longer than half as much again as usual, for a hole is none.
double interval_at(const std::vector<Instant>& stamp, std::size_t row, Stamp stamps, double usual) {
    if (stamp.size() < 2) return 0.0;
    const std::size_t upper =
        stamps == Stamp::end ? std::max<std::size_t>(row, 1) : std::min(row + 1, stamp.size() - 1);
    const double step = seconds_between(stamp[upper - 1], stamp[upper]);
    return step > 1.5 * usual ? usual : step;
}

/// The instants that rows represent.
std::vector<Instant> placed(const WeatherTable& table, Stamp stamps) {
    std::vector<Instant> instant = table.stamp;
    if (stamps == Stamp::instant) {
        for (Instant& one : instant) one = later(one, table.light_offset);
        return instant;
    }
    const double usual = usual_interval(table.stamp);
    const double way = stamps == Stamp::end ? -0.5 : 0.5;
    for (std::size_t i = 0; i < instant.size(); ++i) {
        instant[i] = later(instant[i], way * interval_at(table.stamp, i, stamps, usual));
    }
    return instant;
}

/// A column at the instants that rows represent: as it is, or from the line between the stamps.
std::vector<double> at_instants(const WeatherTable& table, Quantity quantity,
                                const std::vector<Instant>& instant) {
    const std::vector<double>& column = table.of(quantity);
    const bool moves =
        facts(quantity).kind == QuantityKind::state || quantity == Quantity::cloud_fraction;
    if (column.empty() || !table.states_at_stamp || !moves) return column;
    std::vector<double> moved;
    for (std::size_t i = 0; i < instant.size(); ++i) {
        const std::size_t other = instant[i] < table.stamp[i] ? std::max<std::size_t>(i, 1) - 1
                                                              : std::min(i + 1, instant.size() - 1);
        const double apart =
            std::isnan(column[other]) ? 0.0 : seconds_between(table.stamp[i], table.stamp[other]);
        const double share =
            apart == 0.0 ? 0.0 : seconds_between(table.stamp[i], instant[i]) / apart;
        moved.push_back(std::lerp(column[i], column[other], std::clamp(share, 0.0, 1.0)));
    }
    return moved;
}

/// One line of what a file does not contain and what replaces it; empty where nothing is missing.
std::string tell_absent(const WeatherTable& table) {
    std::string absent;
    const auto say = [&](const std::string& what) {
        absent += (absent.empty() ? "" : ", ") + what;
    };
    for (std::size_t q = 0; q < quantity_count; ++q) {
        const Quantity quantity = quantity_at(q);
        if (!facts(quantity).modelled || table.has(quantity)) continue;
        if (quantity == Quantity::relative_humidity && table.has(Quantity::dew_point)) continue;
        if (quantity == Quantity::pressure && table.has(Quantity::altimeter)) continue;
        say(facts(quantity).modelled);
    }
    if (!table.has(Quantity::shortwave_down) && !table.has(Quantity::direct_normal) &&
        !table.has(Quantity::plane_of_array)) {
        say("sunlight");
    }
    return absent.empty() ? "" : "modelled, not measured: " + absent;
}

struct Columns {
    std::array<std::vector<double>, quantity_count> of;

    double at(Quantity quantity, std::size_t row, double otherwise) const {
        const std::vector<double>& column = of[index(quantity)];
        return column.empty() || std::isnan(column[row]) ? otherwise : column[row];
    }
};

Forcing forcing_of(const Columns& columns, std::size_t row, double elevation) {
    using enum Quantity;
    Forcing f;
    f.air.temperature = columns.at(air_temperature, row, not_measured);
    const double qnh = columns.at(altimeter, row, not_measured);
    f.air.pressure = columns.at(
        pressure, row,
        std::isnan(qnh) ? standard_pressure(elevation) : station_pressure(qnh, elevation));
    const double dew = columns.at(dew_point, row, not_measured);
    f.air.vapour_pressure = std::isnan(dew)
                                ? columns.at(relative_humidity, row, usual_humidity) *
                                      saturation_vapour_pressure(f.air.temperature)
                                : saturation_vapour_pressure(std::min(dew, f.air.temperature));
    f.air.vapour_pressure = std::min(f.air.vapour_pressure, f.air.pressure);
    // An anemometer at rest may read a little less than nothing.
    f.wind_speed = std::max(0.0, columns.at(wind_speed, row, f.wind_speed));
    f.rain_mm_h = columns.at(rain, row, f.rain_mm_h);
    f.cloud_fraction = columns.at(cloud_fraction, row, not_measured);
    f.shortwave_down = columns.at(shortwave_down, row, not_measured);
    f.direct_normal = columns.at(direct_normal, row, not_measured);
    f.diffuse = columns.at(diffuse, row, not_measured);
    f.shortwave_up = columns.at(shortwave_up, row, not_measured);
    f.plane_of_array = columns.at(plane_of_array, row, not_measured);
    f.longwave_down = columns.at(longwave_down, row, not_measured);
    return f;
}

}  // namespace

double station_pressure(double altimeter, double elevation) {
    return altimeter * std::pow(1.0 - 0.0065 * elevation / 288.0, 5.2561);
}

CoveredSpan covered_span(const WeatherTable& table, Stamp stamps) {
    const double usual = usual_interval(table.stamp);
    const std::vector<Instant>& stamp = table.stamp;
    CoveredSpan span{stamp.front(), stamp.back()};
    if (stamps == Stamp::instant && table.light_offset != 0.0) {
        span = {later(span.begin, table.light_offset), later(span.end, table.light_offset)};
    }
    if (stamps == Stamp::end) span.begin = later(span.begin, -interval_at(stamp, 0, stamps, usual));
    if (stamps == Stamp::start) {
        span.end = later(span.end, interval_at(stamp, stamp.size() - 1, stamps, usual));
    }
    return span;
}

Weather weather_series(const WeatherTable& table, Stamp stamps, double elevation) {
    Weather weather{.instant = placed(table, stamps), .sample = {}};
    const double usual = usual_interval(table.stamp);
    for (std::size_t i = 0; stamps != Stamp::instant && i < table.stamp.size(); ++i) {
        weather.span.push_back(interval_at(table.stamp, i, stamps, usual));
    }
    weather.wind_height = table.wind_height;
    weather.air_height = table.air_height;
    Columns columns;
    for (std::size_t q = 0; q < quantity_count; ++q) {
        columns.of[q] = at_instants(table, quantity_at(q), weather.instant);
    }
    for (std::size_t row = 0; row < weather.instant.size(); ++row) {
        weather.sample.push_back(forcing_of(columns, row, elevation));
    }
    weather.warnings = table.warnings;
    weather.station = table.place;
    weather.declarable = table.declarable;
    weather.note = tell_absent(table);
    for (const std::string& note : table.notes) {
        weather.note += (weather.note.empty() ? "" : "; ") + note;
    }
    return weather;
}

}  // namespace diurna
