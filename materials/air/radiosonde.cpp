#include "materials/air/radiosonde.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
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
    if (!(value >= least && value <= most)) {
        throw InputError(table.where(row, column) + ": " + table.header[column],
                         fmt::format("found {:g}, expected {:g} to {:g}", value, least, most));
    }
    return value;
}

}  // namespace

Profile read_radiosonde(const std::filesystem::path& file, const std::string& above) {
    constexpr std::size_t water = static_cast<std::size_t>(Gas::water);
    const Profile model = afgl_profile(above);
    CsvTable table = read_csv(file);
    if (table.rows.size() < 2 || table.rows.size() > 5000) {
        throw InputError(file.string(),
                         fmt::format("found {} levels, expected 2 to 5000", table.rows.size()));
    }
    const std::size_t height = one_of(table, {"height_km", "height_m"});
    const double to_km = table.header[height] == "height_m" ? 1e-3 : 1.0;
    if (table.number(0, height) > table.number(table.rows.size() - 1, height)) {
        std::reverse(table.rows.begin(), table.rows.end());
        std::reverse(table.line.begin(), table.line.end());
    }
    const std::size_t temperature = one_of(table, {"temperature_K", "temperature_C"});
    const double zero = table.header[temperature] == "temperature_C" ? zero_celsius : 0.0;
    const std::size_t humidity =
        one_of(table, {"relative_humidity_percent", "dew_point_C", "mixing_ratio_g_kg"});
    const std::size_t pressure = one_of(table, {"pressure_hPa"});

    Profile sonde;
    sonde.name = above;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const double z = in_range(table, row, height, -0.5 / to_km, 60.0 / to_km) * to_km;
        const double t = in_range(table, row, temperature, 150.0 - zero, 350.0 - zero) + zero;
        double p;
        if (table.rows[row][pressure].empty() && row > 0) {
            const double mean = 0.5 * (t + sonde.temperature.back());
            p = sonde.pressure_hPa.back() *
                std::exp(-gravity * 1e3 * (z - sonde.height_km.back()) / (287.05 * mean));
        } else {
            p = in_range(table, row, pressure, 0.1, 1100.0);
        }
        if (row > 0 && !(z > sonde.height_km.back())) {
            throw InputError(table.where(row, height) + ": " + table.header[height],
                             "heights must ascend, or descend, from level to level");
        }
        if (row > 0 && !(p < sonde.pressure_hPa.back())) {
            throw InputError(table.where(row, pressure) + ": pressure_hPa",
                             fmt::format("found {:g} above {:g}, expected it to fall with height",
                                         p, sonde.pressure_hPa.back()));
        }
        double vapour;
        if (table.header[humidity] == "dew_point_C") {
            vapour = saturation_hPa(kelvin(in_range(table, row, humidity, -120.0, 50.0)));
        } else if (table.header[humidity] == "mixing_ratio_g_kg") {
            const double w = in_range(table, row, humidity, 0.0, 60.0) * 1e-3;
            vapour = p * w / (0.62198 + w);
        } else {
            vapour = 0.01 * in_range(table, row, humidity, 0.0, 102.0) * saturation_hPa(t);
        }
        sonde.height_km.push_back(z);
        sonde.pressure_hPa.push_back(p);
        sonde.temperature.push_back(t);
        const AirSample air = air_at(model, z);
        for (std::size_t gas = 0; gas < gas_count; ++gas) {
            sonde.mixing_ratio_ppm[gas].push_back(air.mixing_ratio_ppm[gas]);
        }
        sonde.mixing_ratio_ppm[water].back() = std::max(1e-3, 1e6 * vapour / p);
    }
    const double top = sonde.height_km.back();
    const AirSample last = air_at(model, top);
    const double warmer = sonde.temperature.back() - last.temperature;
    const double denser = std::log(sonde.pressure_hPa.back() / last.pressure_hPa);
    const double wetter =
        std::log(sonde.mixing_ratio_ppm[water].back() / last.mixing_ratio_ppm[water]);
    for (std::size_t i = 0; i < model.height_km.size(); ++i) {
        const double z = model.height_km[i];
        if (z < top + 0.01) continue;
        const double share = std::max(0.0, 1.0 - (z - top) / join_km);
        sonde.height_km.push_back(z);
        sonde.temperature.push_back(model.temperature[i] + share * warmer);
        sonde.pressure_hPa.push_back(model.pressure_hPa[i] * std::exp(share * denser));
        for (std::size_t gas = 0; gas < gas_count; ++gas) {
            sonde.mixing_ratio_ppm[gas].push_back(model.mixing_ratio_ppm[gas][i]);
        }
        sonde.mixing_ratio_ppm[water].back() *= std::exp(share * wetter);
    }
    check(sonde);
    return sonde;
}

Profile named_profile(const std::string& name) {
    return name.ends_with(".csv") ? read_radiosonde(name) : afgl_profile(name);
}

}  // namespace diurna
