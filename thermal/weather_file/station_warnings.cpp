#include "thermal/weather_file/station_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double far_km = 50.0, far_up_m = 200.0, earth_km = 6371.0;

}  // namespace

double distance_km(const Geodetic& a, const Geodetic& b) {
    const double north = radians(a.latitude_deg), here = radians(b.latitude_deg);
    const double east = radians(a.longitude_deg - b.longitude_deg);
    const double half = std::pow(std::sin(0.5 * (north - here)), 2) +
                        std::cos(north) * std::cos(here) * std::pow(std::sin(0.5 * east), 2);
    return 2.0 * earth_km * std::asin(std::min(1.0, std::sqrt(half)));
}

void warn_of_place(WeatherTable& table, const WeatherPlace& place) {
    if (!table.place || !place.site) return;
    const Geodetic& station = *table.place;
    const double km =
        distance_km(station, {place.site->latitude_deg, place.site->longitude_deg, 0.0});
    if (km > far_km) {
        table.warnings.push_back(
            {table.file.string(),
             fmt::format("its station, at {:.3f} N {:.3f} E, is {:.0f} km from the site at {:.3f} "
                         "N {:.3f} E",
                         station.latitude_deg, station.longitude_deg, km, place.site->latitude_deg,
                         place.site->longitude_deg),
             "check the file, site.latitude_deg and site.longitude_deg"});
    }
    const double up = station.height - place.elevation;
    if (std::abs(up) > far_up_m && !place.height_named) {
        table.warnings.push_back(
            {table.file.string(),
             fmt::format("its station, at {:.0f} m above the sea, is {:.0f} m {} than the site at "
                         "{:.0f} m",
                         station.height, std::abs(up), up > 0.0 ? "higher" : "lower",
                         place.elevation),
             place.carried ? "air, pressure and sky are adjusted to the site's height by "
                             "weather.lapse; weather.height_m, if given, is the station's height"
                           : "the weather is used unchanged: check site.elevation_m"});
    }
}

}  // namespace diurna
