#include "thermal/weather_file/era5.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

constexpr double hour = 3600.0;  // [s]

/// Throws InputError where a flux is more than an hour can bring: then it is a longer sum.
void check_hourly(const WeatherTable& table, const std::string& name, double flux,
                  std::size_t row) {
    if (!(flux > 1500.0)) return;
    throw InputError(
        table.where[row],
        fmt::format("found {:.0f} J/m2 of {}, more than one hour brings", flux * hour, name),
        "sums since midnight (ERA5-Land) must be taken apart into hours first");
}

}  // namespace

const std::vector<std::string>& era5_names() {
    static const std::vector<std::string> names{"t2m",  "d2m",  "u10",  "v10", "sp",
                                                "ssrd", "strd", "fdir", "tp",  "tcc"};
    return names;
}

void put_era5(const Era5Values& values, WeatherTable& table) {
    table.stamps = Stamp::end;
    table.states_at_stamp = true;
    const auto take = [&](const char* name, Quantity quantity, double factor) {
        const auto found = values.find(name);
        if (found == values.end()) return;
        std::vector<double>& column = table.of(quantity);
        for (std::size_t i = 0; i < found->second.size(); ++i) {
            column.push_back(factor * found->second[i]);
            if (factor == 1.0 / hour) check_hourly(table, name, column.back(), i);
            check_range(quantity, column.back(), table.where[i]);
        }
    };
    take("t2m", Quantity::air_temperature, 1.0);
    take("d2m", Quantity::dew_point, 1.0);
    take("sp", Quantity::pressure, 1.0);
    take("tcc", Quantity::cloud_fraction, 1.0);
    take("ssrd", Quantity::shortwave_down, 1.0 / hour);
    take("strd", Quantity::longwave_down, 1.0 / hour);
    take("tp", Quantity::rain, 1000.0);
    const auto u = values.find("u10"), v = values.find("v10");
    if (u != values.end() && v != values.end()) {
        for (std::size_t i = 0; i < u->second.size(); ++i) {
            table.of(Quantity::wind_speed).push_back(std::hypot(u->second[i], v->second[i]));
        }
    }
    const auto beam = values.find("fdir");
    if (beam != values.end() && table.has(Quantity::shortwave_down)) {
        for (std::size_t i = 0; i < beam->second.size(); ++i) {
            const double global = table.of(Quantity::shortwave_down)[i];
            table.of(Quantity::diffuse).push_back(std::max(0.0, global - beam->second[i] / hour));
        }
    }
    if (!table.has(Quantity::air_temperature)) {
        throw InputError(table.file.string(), "no t2m, the air's temperature, in it",
                         "ask for 2m_temperature as well; files of accumulated variables alone "
                         "must be joined with those of instantaneous ones");
    }
    const double usual = usual_interval(table.stamp);
    if (usual > 1.5 * hour &&
        (table.has(Quantity::shortwave_down) || table.has(Quantity::longwave_down))) {
        table.notes.push_back(fmt::format(
            "ERA5's radiation is of the last hour of each {:g} h, taken for all of them",
            usual / hour));
    }
}

}  // namespace diurna
