#include "thermal/weather_file/unused_columns.hpp"

#include <catch2/catch.hpp>
#include <string>

using namespace diurna;

TEST_CASE("a column's name is known by its words", "[thermal][weather_file]") {
    const auto [name, quantity] = GENERATE(table<std::string, Quantity>({
        {"wind_kmh", Quantity::wind_speed},
        {"windSpeed", Quantity::wind_speed},
        {"Wspd (m/s)", Quantity::wind_speed},
        {"wind_sped_m_s", Quantity::wind_speed},
        {"rh", Quantity::relative_humidity},
        {"Relative Humidity", Quantity::relative_humidity},
        {"Dew Point", Quantity::dew_point},
        {"surface_pressure_hPa", Quantity::pressure},
        {"GHI", Quantity::shortwave_down},
        {"solar_radiation", Quantity::shortwave_down},
        {"Direct Normal Irradiance (DNI) W/m2", Quantity::direct_normal},
        {"diffuse_horizontal", Quantity::diffuse},
        {"longwave_in", Quantity::longwave_down},
        {"Horizontal Infrared", Quantity::longwave_down},
        {"precip_mm", Quantity::rain},
        {"CloudCover", Quantity::cloud_fraction},
        {"relative_humidty", Quantity::relative_humidity},
    }));
    CAPTURE(name);
    CHECK(looks_like(name) == quantity);
}

TEST_CASE("a column that only begins like a quantity is not read as one",
          "[thermal][weather_file]") {
    const std::string name = GENERATE(
        "wind_direction", "Wdir", "wind_gust_kn", "Clearsky DNI", "clear_sky_ghi", "cloud_type",
        "Solar Zenith Angle", "Fill Flag", "station", "remarks", "id", "Surface Albedo",
        "soil_temperature", "DataVersion", "visibility_m", "Precipitable Water");
    CAPTURE(name);
    CHECK_FALSE(looks_like(name));
}
