#include "thermal/weather_file/quantity.hpp"

#include <array>
#include <span>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

using enum QuantityKind;

constexpr std::array<QuantityFacts, quantity_count> all{{
    {"air_temperature", "air_temperature_K", 100.0, 400.0, state, nullptr},
    {"dew_point", "dew_point_K", 1.0, 400.0, state, nullptr},
    {"relative_humidity", "relative_humidity", 0.0, 1.1, state, "humidity 0.5"},
    {"pressure", "pressure_Pa", 100.0, 120000.0, state, "pressure of the standard atmosphere"},
    {"altimeter", "altimeter_Pa", 50000.0, 120000.0, state, nullptr},
    {"wind_speed", "wind_speed_m_s", -0.5, 120.0, state, "wind 1 m/s"},
    {"rain", "rain_mm_h", 0.0, 2000.0, other, nullptr},
    {"cloud_fraction", "cloud_fraction", 0.0, 1.0, other, nullptr},
    {"shortwave_down", "shortwave_down_W_m2", -100.0, 2500.0, sunlight, nullptr},
    {"direct_normal", "direct_normal_W_m2", -100.0, 2500.0, sunlight, nullptr},
    {"diffuse", "diffuse_W_m2", -100.0, 2500.0, sunlight, nullptr},
    {"shortwave_up", "shortwave_up_W_m2", -100.0, 2500.0, other, nullptr},
    {"plane_of_array", "plane_of_array_W_m2", -100.0, 3000.0, sunlight, nullptr},
    {"longwave_down", "longwave_down_W_m2", 0.0, 1000.0, longwave, "longwave"},
}};

struct NamedUnit {
    const char* name;
    Unit unit;
};

// Factors: 9th CGPM and NIST SP 811 (kn, mph, inHg, in).
constexpr double zero_fahrenheit = zero_celsius - 32.0 * 5.0 / 9.0;  // [K] of 0 °F
constexpr std::array<NamedUnit, 6> of_temperature{{{"K", {}},
                                                   {"degC", {1.0, zero_celsius}},
                                                   {"°C", {1.0, zero_celsius}},
                                                   {"C", {1.0, zero_celsius}},
                                                   {"degF", {5.0 / 9.0, zero_fahrenheit}},
                                                   {"°F", {5.0 / 9.0, zero_fahrenheit}}}};
constexpr std::array<NamedUnit, 2> of_humidity{{{"1", {}}, {"%", {0.01}}}};
constexpr std::array<NamedUnit, 6> of_pressure{{{"Pa", {}},
                                                {"hPa", {100.0}},
                                                {"mbar", {100.0}},
                                                {"mb", {100.0}},
                                                {"kPa", {1000.0}},
                                                {"inHg", {3386.389}}}};
constexpr std::array<NamedUnit, 6> of_speed{{{"m/s", {}},
                                             {"kn", {1852.0 / 3600.0}},
                                             {"kt", {1852.0 / 3600.0}},
                                             {"knots", {1852.0 / 3600.0}},
                                             {"km/h", {1.0 / 3.6}},
                                             {"mph", {0.44704}}}};
constexpr std::array<NamedUnit, 5> of_rain{{{"mm/h", {}},
                                            {"in/h", {25.4}},
                                            {"mm", {3600.0, 0.0, true}},
                                            {"in", {25.4 * 3600.0, 0.0, true}},
                                            {"m", {1000.0 * 3600.0, 0.0, true}}}};
constexpr std::array<NamedUnit, 4> of_cloud{
    {{"1", {}}, {"%", {0.01}}, {"okta", {0.125}}, {"tenths", {0.1}}}};
constexpr std::array<NamedUnit, 6> of_flux{{{"W/m2", {}},
                                            {"W/m²", {}},
                                            {"J/m2", {1.0, 0.0, true}},
                                            {"kJ/m2", {1e3, 0.0, true}},
                                            {"MJ/m2", {1e6, 0.0, true}},
                                            {"Wh/m2", {3600.0, 0.0, true}}}};

std::span<const NamedUnit> units_of(Quantity quantity) {
    switch (quantity) {
        case Quantity::air_temperature:
        case Quantity::dew_point:
            return of_temperature;
        case Quantity::relative_humidity:
            return of_humidity;
        case Quantity::pressure:
        case Quantity::altimeter:
            return of_pressure;
        case Quantity::wind_speed:
            return of_speed;
        case Quantity::rain:
            return of_rain;
        case Quantity::cloud_fraction:
            return of_cloud;
        default:
            return of_flux;
    }
}

}  // namespace

const QuantityFacts& facts(Quantity quantity) { return all[index(quantity)]; }

std::optional<Quantity> quantity_named(std::string_view name) {
    for (std::size_t i = 0; i < quantity_count; ++i) {
        if (name == all[i].name) return quantity_at(i);
    }
    return std::nullopt;
}

std::optional<Quantity> quantity_of_column(std::string_view column) {
    for (std::size_t i = 0; i < quantity_count; ++i) {
        if (column == all[i].column) return quantity_at(i);
    }
    return std::nullopt;
}

std::vector<std::string> quantity_names() {
    std::vector<std::string> names;
    for (const QuantityFacts& one : all) names.emplace_back(one.name);
    return names;
}

std::optional<Unit> unit_named(Quantity quantity, std::string_view name) {
    if (name.empty()) return Unit{};
    for (const NamedUnit& unit : units_of(quantity)) {
        if (name == unit.name) return unit.unit;
    }
    return std::nullopt;
}

std::vector<std::string> unit_names(Quantity quantity) {
    std::vector<std::string> names;
    for (const NamedUnit& unit : units_of(quantity)) names.emplace_back(unit.name);
    return names;
}

}  // namespace diurna
