#include "thermal/weather_file/weather_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

void add_row(WeatherTable& table, Instant stamp, const std::string& where) {
    if (!table.stamp.empty() && stamp <= table.stamp.back()) {
        throw InputError(
            where, fmt::format("{} is not later than the previous row", format_instant(stamp)),
            "times must ascend; where clocks change, write UTC offsets");
    }
    table.stamp.push_back(stamp);
    table.where.push_back(where);
    for (std::vector<double>& column : table.value) {
        if (!column.empty()) column.resize(table.stamp.size(), not_measured);
    }
}

namespace {

/// The unit that a value out of range is likely to have; "" where none is.
std::string likely_unit(Quantity quantity, double value) {
    switch (quantity) {
        case Quantity::air_temperature:
        case Quantity::dew_point:
            return value < 0.0 || value <= 60.0 ? "degC" : value <= 140.0 ? "degF" : "";
        case Quantity::relative_humidity:
            return value > 1.0 && value <= 110.0 ? "%" : "";
        case Quantity::cloud_fraction:
            return value > 100.0 ? "" : value > 10.0 ? "%" : value > 8.0 ? "tenths" : "okta";
        case Quantity::shortwave_down:
        case Quantity::direct_normal:
        case Quantity::diffuse:
        case Quantity::longwave_down:
            return value > 0.0 ? "J/m2" : "";
        default:
            return "";
    }
}

/// Numbers such as -999 and 9999 that mark missing values.
bool stands_for_none(double value) {
    std::string digits = fmt::format("{:g}", std::abs(value));
    std::erase(digits, '.');
    return digits.size() > 1 && digits.find_first_not_of('9') == std::string::npos;
}

}  // namespace

void check_range(Quantity quantity, double value, const std::string& where, bool declarable,
                 double read) {
    const QuantityFacts& f = facts(quantity);
    if (!(value < f.least || value > f.most)) return;
    const double cell = std::isnan(read) ? value : read;
    const bool converted = cell != value;
    const std::string unit = converted ? "" : likely_unit(quantity, value);
    throw InputError(
        where,
        fmt::format(
            "found {:g}{}; {} is between {:g} and {:g}", cell,
            converted ? fmt::format(", which is {:g} in the unit of {}", value, f.column) : "",
            f.column, f.least, f.most),
        stands_for_none(cell) && declarable
            ? fmt::format("leave the cell empty if the value is missing, or declare the code: "
                          "missing = [{:g}] in [weather]",
                          cell)
        : converted && declarable ? "check the unit in [weather.columns]"
        : unit.empty() || !declarable
            ? ""
            : fmt::format(
                  "seems to have another unit: declare it in [weather.columns] as \"{} {}\"",
                  f.name, unit));
}

void put(WeatherTable& table, Quantity quantity, double value, const std::string& where) {
    check_range(quantity, value, where, table.declarable);
    std::vector<double>& column = table.of(quantity);
    column.resize(table.stamp.size(), not_measured);
    column.back() = value;
}

double usual_interval(const std::vector<Instant>& stamp) {
    if (stamp.size() < 2) return 0.0;
    std::vector<double> step;
    for (std::size_t i = 1; i < stamp.size(); ++i) {
        step.push_back(seconds_between(stamp[i - 1], stamp[i]));
    }
    const auto middle = step.begin() + static_cast<std::ptrdiff_t>((step.size() - 1) / 2);
    std::nth_element(step.begin(), middle, step.end());
    return *middle;
}

Instant local_instant(int year, int month, int day, double seconds, double offset_h,
                      const std::string& where) {
    using namespace std::chrono;
    const year_month_day date{std::chrono::year(year), std::chrono::month(unsigned(month)),
                              std::chrono::day(unsigned(day))};
    if (!date.ok() || seconds < 0.0 || seconds > 86400.0) {
        throw InputError(where, fmt::format("{}-{}-{} {:g} h does not exist", year, month, day,
                                            seconds / 3600.0));
    }
    return later(Instant(sys_days(date)), seconds - 3600.0 * offset_h);
}

}  // namespace diurna
