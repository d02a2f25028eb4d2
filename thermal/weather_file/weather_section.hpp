#pragma once

#include <string>
#include <vector>

#include "materials/base/section.hpp"
#include "thermal/weather_file/read_weather.hpp"

namespace diurna {

/// What `file` of [weather] is.
inline constexpr const char* weather_file_says =
    "EPW, TMY3, NSRDB (PSM), SolarAnywhere, PVGIS, SURFRAD, BSRN or ERA5 (CSV, netCDF, the data "
    "store's zip), recognised by content, or CSV with columns as in "
    "thermal/weather_file/README.md; or an array of files of one format, whose rows are joined";

/// The keys of [weather] in scene and column files except its file: meaning of time stamps,
/// columns, heights of wind and air, treatment of gaps.
///
/// lowest_wind  [m] smallest allowed height of a wind measurement
WeatherOptions read_weather_options(const Section& section, double lowest_wind);

/// Change of air with height from the weather's: the keys `height_m`, which is stored in the
/// options, and `lapse`.
struct HeightKeys {
    double lapse = -6.5e-3;   // [K m⁻¹]
    bool by_profile = false;  // by the air's profile instead
};
/// sounded  there is a radiosonde's profile, which is used unless a lapse is given
HeightKeys read_height_keys(const Section& section, bool sounded, WeatherOptions& options);

/// `measured_over` of [weather]: the name of the material below the pyranometers; "" if not
/// given.
std::string read_measured_over(const Section& section, const std::vector<std::string>& materials);

}  // namespace diurna
