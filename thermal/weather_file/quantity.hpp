#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// What a column of a weather file may hold.
enum class Quantity {
    air_temperature,    // [K]
    dew_point,          // [K]; gives the humidity if that is absent
    relative_humidity,  // 0 to 1, over water
    pressure,           // [Pa] at the station
    altimeter,          // [Pa] QNH: reduced to sea level, by the standard atmosphere
    wind_speed,         // [m s⁻¹]
    rain,               // [mm h⁻¹]
    cloud_fraction,     // 0 to 1
    shortwave_down,     // [W m⁻²] global, on the horizontal
    direct_normal,      // [W m⁻²]
    diffuse,            // [W m⁻²]
    shortwave_up,       // [W m⁻²]
    plane_of_array,     // [W m⁻²]
    longwave_down,      // [W m⁻²]
};
inline constexpr std::size_t quantity_count = 14;
inline constexpr std::size_t index(Quantity q) { return static_cast<std::size_t>(q); }
inline constexpr Quantity quantity_at(std::size_t i) { return static_cast<Quantity>(i); }

/// Kind of a quantity. States are instantaneous in files whose stamps end intervals of sunlight;
/// sunlight is zero at night whatever a file says; others may be absent at any time.
enum class QuantityKind { state, sunlight, longwave, other };

struct QuantityFacts {
    const char* name;    // in [weather.columns]
    const char* column;  // of the program's own CSV, with its unit
    double least, most;  // limits beyond all records at the ground
    QuantityKind kind;
    const char* modelled;  // its replacement if absent, or null
};
const QuantityFacts& facts(Quantity quantity);
std::optional<Quantity> quantity_named(std::string_view name);
std::optional<Quantity> quantity_of_column(std::string_view column);
std::vector<std::string> quantity_names();

/// Conversion of a file's numbers to SI: factor · x + offset; sums over an interval are also
/// divided by its seconds.
struct Unit {
    double factor = 1.0;
    double offset = 0.0;
    bool per_interval = false;
};
/// By its usual spellings: K, degC, °C, C, degF; 1, %; Pa, hPa, mbar, kPa, inHg; m/s, kn, kt, km/h,
/// mph; mm/h, in/h, mm, in, m (of an interval); okta, tenths; W/m2, J/m2, kJ/m2, MJ/m2, Wh/m2 (of
/// an interval). "" is SI's.
std::optional<Unit> unit_named(Quantity quantity, std::string_view name);
/// The allowed words, for messages.
std::vector<std::string> unit_names(Quantity quantity);

}  // namespace diurna
