#include "materials/air/radiosonde.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/air/moist_air.hpp"
#include "materials/air/seasonal_profile.hpp"
#include "materials/air/sounding_levels.hpp"
#include "materials/air/sounding_table.hpp"
#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double join_km = 5.0;  // over which a profile joins the model above it

/// Saturation over water [hPa] (Bolton 1980, 0.3 % from -35 to 35 °C).
double saturation_hPa(double temperature) {
    const double t = celsius(temperature);
    return 6.112 * std::exp(17.67 * t / (t + 243.5));
}

std::size_t one_of(const CsvTable& table, std::initializer_list<const char*> names) {
    for (const char* name : names) {
        if (table.has(name)) return table.column(name);
    }
    throw InputError(table.path.string(),
                     fmt::format("no column {} in the header", fmt::join(names, " or ")));
}

double in_range(const CsvTable& table, std::size_t row, std::size_t column, double least,
                double most) {
    const double value = table.number(row, column);
    check_within(table.where(row, column) + ": " + table.header[column], value, least, most);
    return value;
}

/// Where the table's columns stand, and what makes their units SI.
struct Columns {
    std::size_t height, temperature, humidity, pressure;
    double to_km;  // of a height
    double zero;   // [K] of the temperature's scale

    explicit Columns(const CsvTable& table)
        : height(one_of(table, {"height_km", "height_m"})),
          temperature(one_of(table, {"temperature_K", "temperature_C"})),
          humidity(
              one_of(table, {"relative_humidity_percent", "dew_point_C", "mixing_ratio_g_kg"})),
          pressure(one_of(table, {"pressure_hPa"})),
          to_km(table.header[height] == "height_m" ? 1e-3 : 1.0),
          zero(table.header[temperature] == "temperature_C" ? zero_celsius : 0.0) {}
};

/// Levels from the ground up, by the way most of them go: one bad height at an end says nothing.
void sort_levels(CsvTable& table, std::size_t height) {
    std::ptrdiff_t rises = 0;
    for (std::size_t row = 1; row < table.rows.size(); ++row) {
        const double step = table.number(row, height) - table.number(row - 1, height);
        rises += step > 0.0 ? 1 : step < 0.0 ? -1 : 0;
    }
    if (rises < 0) {
        std::reverse(table.rows.begin(), table.rows.end());
        std::reverse(table.line.begin(), table.line.end());
    }
}

double vapour_hPa(const CsvTable& table, std::size_t row, std::size_t column, double temperature,
                  double pressure_hPa) {
    if (table.header[column] == "dew_point_C") {
        return saturation_hPa(kelvin(in_range(table, row, column, -120.0, 50.0)));
    }
    if (table.header[column] == "mixing_ratio_g_kg") {
        const double w = in_range(table, row, column, 0.0, 60.0) * 1e-3;
        return pressure_hPa * w / (water_over_dry_air + w);
    }
    return 0.01 * in_range(table, row, column, 0.0, 102.0) * saturation_hPa(temperature);
}

/// Throws InputError for humidity that is a share in a column of per cent: none above 1 in levels
/// that the ground's air reaches.
void check_percent(const CsvTable& table, const Columns& columns) {
    if (table.header[columns.humidity] != "relative_humidity_percent") return;
    double most = 0.0;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        if (table.rows[row][columns.humidity].empty()) continue;
        most = std::max(most, table.number(row, columns.humidity));
    }
    if (!(most > 0.0 && most <= 1.0)) return;
    throw InputError(table.where(0, columns.humidity) + ": relative_humidity_percent",
                     fmt::format("found at most {:g} % at all levels, expected 0 to 100", most),
                     "multiply shares of 1 by 100");
}

/// Throws InputError for heights and pressures that contradict hydrostatic balance by more than a
/// factor of 1.5 over the whole sounding: heights in feet are 3.3 times too large.
void check_heights(const CsvTable& table, const Columns& columns, const Profile& sonde,
                   std::size_t levels) {
    const double rise = 1e3 * (sonde.height_km[levels - 1] - sonde.height_km[0]);  // [m]
    double balanced = 0.0;
    for (std::size_t i = 1; i < levels; ++i) {
        balanced += dry_air_gas_constant / gravity * 0.5 *
                    (sonde.temperature[i] + sonde.temperature[i - 1]) *
                    std::log(sonde.pressure_hPa[i - 1] / sonde.pressure_hPa[i]);
    }
    constexpr double least_rise = 500.0, most_apart = 1.5;
    if (rise < least_rise || std::abs(std::log(rise / balanced)) < std::log(most_apart)) return;
    throw InputError(
        table.where(0, columns.height) + ": " + table.header[columns.height],
        fmt::format("found a rise of {:.0f} m between {:.0f} and {:.0f} hPa, expected about {:.0f} "
                    "m by hydrostatic balance",
                    rise, sonde.pressure_hPa[0], sonde.pressure_hPa[levels - 1], balanced),
        rise / balanced > 3.0 && rise / balanced < 3.6 ? "multiply heights in feet by 0.3048"
                                                       : "check the units of height and pressure");
}

/// Adds a row's level; gases besides water are the model's.
void add_level(const CsvTable& table, std::size_t row, const Columns& columns, const Profile& model,
               Profile& sonde) {
    const double z = columns.to_km * in_range(table, row, columns.height, -0.5 / columns.to_km,
                                              60.0 / columns.to_km);
    const double t =
        in_range(table, row, columns.temperature, 150.0 - columns.zero, 350.0 - columns.zero) +
        columns.zero;
    double p;
    if (table.rows[row][columns.pressure].empty() && row > 0) {
        const double mean = 0.5 * (t + sonde.temperature.back());
        p = sonde.pressure_hPa.back() *
            std::exp(-gravity * 1e3 * (z - sonde.height_km.back()) / (dry_air_gas_constant * mean));
    } else {
        p = in_range(table, row, columns.pressure, 0.1, 1100.0);
    }
    if (row > 0 && !(z > sonde.height_km.back())) {
        throw InputError(table.where(row, columns.height) + ": " + table.header[columns.height],
                         "heights must ascend or descend from level to level");
    }
    if (row > 0 && !(p < sonde.pressure_hPa.back())) {
        throw InputError(
            table.where(row, columns.pressure) + ": pressure_hPa",
            fmt::format("found {:g} above {:g}, expected pressures that decrease with height", p,
                        sonde.pressure_hPa.back()));
    }
    AirSample air = air_at(model, z);
    air.pressure_hPa = p;
    air.temperature = t;
    if (!table.rows[row][columns.humidity].empty()) {
        air.mixing_ratio_ppm[static_cast<std::size_t>(Gas::water)] =
            std::max(1e-3, 1e6 * vapour_hPa(table, row, columns.humidity, t, p) / p);
    }
    append_level(sonde, z, air);
}

/// That of the season, by the highest level up to 3 km above the lowest: free of the ground's own
/// days and nights.
Profile model_of(const CsvTable& table, const Columns& columns) {
    const auto height_km = [&](std::size_t row) {
        return columns.to_km * table.number(row, columns.height);
    };
    std::size_t row = 0;
    while (row + 1 < table.rows.size() && height_km(row + 1) <= height_km(0) + 3.0) ++row;
    return seasonal_profile(height_km(row), table.number(row, columns.temperature) + columns.zero);
}

/// The model's levels above the last, made to join it.
void add_model_above(const Profile& model, Profile& sonde) {
    constexpr auto water = static_cast<std::size_t>(Gas::water);
    const double top = sonde.height_km.back();
    const AirSample last = air_at(model, top);
    const AirChange change{
        .warmer = sonde.temperature.back() - last.temperature,
        .ln_pressure = std::log(sonde.pressure_hPa.back() / last.pressure_hPa),
        .ln_water = std::log(sonde.mixing_ratio_ppm[water].back() / last.mixing_ratio_ppm[water])};
    for (std::size_t level = 0; level < model.height_km.size(); ++level) {
        const double z = model.height_km[level];
        if (z < top + 0.01) continue;
        append_level(sonde, z, sample_of(model, level));
        change_level(sonde, sonde.height_km.size() - 1, change,
                     std::max(0.0, 1.0 - (z - top) / join_km));
    }
}

}  // namespace

Profile read_radiosonde(const std::filesystem::path& file, const std::string& above,
                        const std::string& time) {
    return read_sounding(file, above, time).profile;
}

Sounding read_sounding(const std::filesystem::path& file, const std::string& above,
                       const std::string& time) {
    SoundingTable sounding = read_sounding_table(file, time);
    CsvTable& table = sounding.table;
    if (table.rows.size() < 2 || table.rows.size() > 5000) {
        throw InputError(file.string(),
                         fmt::format("found {} levels, expected 2 to 5000", table.rows.size()));
    }
    const Columns columns(table);
    sort_levels(table, columns.height);
    check_percent(table, columns);
    Profile sonde;
    sonde.notes = std::move(sounding.notes);
    // Archives hold every level of a flight as it was sent; a table of one's own is to be in order.
    const double most = sounding.archive ? 0.5 : 0.1;
    if (std::string note = leave_out_bounces(table, columns.height, columns.pressure, most);
        !note.empty()) {
        sonde.notes.push_back(std::move(note));
    }
    const Profile model = above.empty() ? model_of(table, columns) : afgl_profile(above);
    sonde.name = model.name;
    sonde.winter = model.winter;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        add_level(table, row, columns, model, sonde);
    }
    const std::size_t levels = sonde.height_km.size();
    check_heights(table, columns, sonde, levels);
    add_model_above(model, sonde);
    check(sonde);
    return {std::move(sonde), levels};
}

Profile named_profile(const std::string& name) {
    const bool file = name.ends_with(".csv") || name.ends_with(".txt") || name.ends_with(".html") ||
                      name.ends_with(".htm");
    return file ? read_radiosonde(name) : afgl_profile(name);
}

}  // namespace diurna
