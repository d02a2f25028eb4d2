#include "thermal/weather_file/era5_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "thermal/weather_file/era5.hpp"

namespace diurna {

namespace {

constexpr double seconds_of_hour = 3600.0;  // [s]

/// Other names of variables: means and rates over the hour (ECMWF parameter database, 235033 ff.),
/// and the numbers that CDO writes for GRIB without a table.
struct Alias {
    const char *variable, *name;
};
constexpr std::array aliases{
    Alias{"avg_sdswrf", "ssrd"}, Alias{"msdwswrf", "ssrd"},     Alias{"avg_sdlwrf", "strd"},
    Alias{"msdwlwrf", "strd"},   Alias{"avg_sdirswrf", "fdir"}, Alias{"msdrswrf", "fdir"},
    Alias{"avg_tprate", "tp"},   Alias{"mtpr", "tp"},           Alias{"var167", "t2m"},
    Alias{"var168", "d2m"},      Alias{"var165", "u10"},        Alias{"var166", "v10"},
    Alias{"var207", "si10"},     Alias{"var134", "sp"},         Alias{"var169", "ssrd"},
    Alias{"var175", "strd"},     Alias{"var228", "tp"},         Alias{"var164", "tcc"}};

/// A unit without blanks, signs of power and case: "W m**-2" as "wm-2".
struct KnownUnit {
    const char *unit, *shown;
    double factor, offset;
};
using Units = std::vector<KnownUnit>;

const Units& units_of(const std::string& name) {
    static const Units kelvin{{"k", "K", 1.0, 0.0},
                              {"kelvin", "", 1.0, 0.0},
                              {"degc", "degC", 1.0, zero_celsius},
                              {"c", "", 1.0, zero_celsius},
                              {"celsius", "", 1.0, zero_celsius},
                              {"degree_celsius", "", 1.0, zero_celsius},
                              {"°c", "", 1.0, zero_celsius}};
    static const Units speed{{"ms-1", "m s-1", 1.0, 0.0},
                             {"m/s", "", 1.0, 0.0},
                             {"kmh-1", "km h-1", 1.0 / 3.6, 0.0},
                             {"km/h", "", 1.0 / 3.6, 0.0}};
    static const Units pressure{{"pa", "Pa", 1.0, 0.0},
                                {"hpa", "hPa", 100.0, 0.0},
                                {"mbar", "", 100.0, 0.0},
                                {"millibars", "", 100.0, 0.0}};
    static const Units share{{"(0-1)", "0 to 1", 1.0, 0.0},   {"1", "", 1.0, 0.0},
                             {"dimensionless", "", 1.0, 0.0}, {"~", "", 1.0, 0.0},
                             {"%", "%", 0.01, 0.0},           {"percent", "", 0.01, 0.0}};
    static const Units sum{{"jm-2", "J m-2", 1.0, 0.0},
                           {"j/m2", "", 1.0, 0.0},
                           {"kjm-2", "kJ m-2", 1e3, 0.0},
                           {"kj/m2", "", 1e3, 0.0},
                           {"mjm-2", "MJ m-2", 1e6, 0.0},
                           {"mj/m2", "", 1e6, 0.0},
                           {"whm-2", "Wh m-2", seconds_of_hour, 0.0},
                           {"wh/m2", "", seconds_of_hour, 0.0},
                           {"wm-2", "W m-2", seconds_of_hour, 0.0},
                           {"w/m2", "", seconds_of_hour, 0.0}};
    static const Units rain{{"m", "m", 1.0, 0.0},
                            {"mofwaterequivalent", "", 1.0, 0.0},
                            {"mm", "mm", 1e-3, 0.0},
                            {"kgm-2", "kg m-2", 1e-3, 0.0},
                            {"kgm-2s-1", "kg m-2 s-1", 1e-3 * seconds_of_hour, 0.0},
                            {"mms-1", "", 1e-3 * seconds_of_hour, 0.0},
                            {"mmh-1", "mm h-1", 1e-3, 0.0},
                            {"mm/h", "", 1e-3, 0.0}};
    if (name == "t2m" || name == "d2m") return kelvin;
    if (name == "u10" || name == "v10" || name == "si10") return speed;
    if (name == "sp") return pressure;
    if (name == "tcc") return share;
    return name == "tp" ? rain : sum;
}

std::string plain_unit(const std::string& text) {
    std::string plain;
    for (const char c : text) {
        if (c == ' ' || c == '*' || c == '^' || c == '.') continue;
        plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    return plain;
}

}  // namespace

std::string era5_name_of(const std::string& variable) {
    if (is_era5_name(variable)) return variable;
    const auto found = std::find_if(aliases.begin(), aliases.end(),
                                    [&](const Alias& one) { return variable == one.variable; });
    return found == aliases.end() ? "" : found->name;
}

Era5Unit era5_unit(const std::string& name, const std::string& variable, const std::string& units,
                   const std::string& where) {
    std::string unit = plain_unit(units);
    const bool of_hour =
        variable.starts_with("avg_") || variable.starts_with("ms") || variable.starts_with("mt");
    if (unit.empty() && of_hour) unit = name == "tp" ? "kgm-2s-1" : "wm-2";
    if (unit.empty()) return {};
    const Units& known = units_of(name);
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const KnownUnit& one) { return unit == one.unit; });
    if (found != known.end()) return {found->factor, found->offset};
    std::vector<std::string> shown;
    for (const KnownUnit& one : known) {
        if (*one.shown != '\0') shown.emplace_back(one.shown);
    }
    throw InputError(where + ": units", fmt::format("found '{}' for {}, expected one of {}", units,
                                                    variable, fmt::join(shown, ", ")));
}

}  // namespace diurna
