#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace diurna {

/// Absorbing gases carried by a profile, in the order of the tables.
enum class Gas {
    water,
    carbon_dioxide,
    ozone,
    nitrous_oxide,
    carbon_monoxide,
    methane,
    oxygen,
    nitric_acid
};
inline constexpr std::size_t gas_count = 8;

/// Vertical profile of the air: levels ascending in height. Pressure and mixing ratios are
/// interpolated in their logarithm, temperature linearly.
struct Profile {
    std::string name;
    std::vector<double> height_km;  // above the sea
    std::vector<double> pressure_hPa;
    std::vector<double> temperature;                              // [K]
    std::array<std::vector<double>, gas_count> mixing_ratio_ppm;  // by volume
    bool winter = false;  // its haze above the boundary layer is the autumn-winter table's
    std::vector<std::string> notes{};  // repairs made to the file that was read
};

/// The six AFGL models by name: TROP MLS MLW SAS SAW US76 (AFGL-TR-86-0110). Throws InputError with
/// the nearest name for any other.
Profile afgl_profile(const std::string& name);
std::vector<std::string> afgl_profile_names();

/// The profile, changed so that the air at `ground_km` has the given temperature [K] and vapour
/// pressure [hPa]; the change fades linearly to zero `depth_km` higher, so that a day's weather
/// changes the boundary layer but not the free troposphere.
Profile with_surface(Profile profile, double ground_km, double temperature,
                     double vapour_pressure_hPa, double depth_km = 1.5);

/// The state of the air at a height [km]; outside the levels that of the nearest level.
struct AirSample {
    double pressure_hPa;
    double temperature;                              // [K]
    std::array<double, gas_count> mixing_ratio_ppm;  // by volume

    double vapour_pressure_hPa() const {
        return pressure_hPa * mixing_ratio_ppm[static_cast<std::size_t>(Gas::water)] * 1e-6;
    }
};
AirSample air_at(const Profile& profile, double height_km);
/// Pressure and temperature only: a quarter of the work.
std::pair<double, double> pressure_and_temperature_at(const Profile& profile, double height_km);

/// The state at one of the profile's levels; the next function adds a level on top.
AirSample sample_of(const Profile& profile, std::size_t level);
void append_level(Profile& profile, double height_km, const AirSample& air);
/// Adds a level with the air already at that height, where a change begins or ends. Adds none above
/// the top, or within a millimetre of an existing level.
void add_level(Profile& profile, double height_km);

/// Difference between two states of the air at one height. A share of it can be applied to another
/// level: temperature by the difference, pressure and water by the ratio.
struct AirChange {
    double warmer = 0.0;                       // [K]
    double ln_pressure = 0.0, ln_water = 0.0;  // logarithms of ratios
};
void change_level(Profile& profile, std::size_t level, const AirChange& change, double share);

/// Throws InputError unless levels ascend, lengths agree, pressures and temperatures are positive
/// and mixing ratios are not negative.
void check(const Profile& profile);

}  // namespace diurna
