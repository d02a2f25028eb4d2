#include "thermal/weather/weather_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/air/moist_air.hpp"
#include "materials/base/number_of.hpp"
#include "materials/base/units.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/weather/light_contradictions.hpp"
#include "thermal/weather/sun_lag.hpp"

namespace diurna {

namespace {

constexpr double least_lag = 2400.0;     // [s] valleys' late dawns make less
constexpr double about = 5.0 * 86400.0;  // [s] before and behind the middle, for the lag

/// A kind of warning: how many samples it is of, and which comes first.
struct WarningKind {
    std::string hint;
    std::string first{};
    std::size_t count = 0;

    /// NaN raises no warning.
    void look(double value, double least, double most, Instant when, const char* what) {
        if (!(value < least || value > most)) return;
        if (count++ > 0) return;
        first = fmt::format("found {} = {:.4g} at {}, expected {:.4g} to {:.4g}", what, value,
                            format_instant(when), least, most);
    }
    void tell(const std::string& where, std::vector<Mistake>& warnings) const {
        if (count == 0) return;
        const std::string more =
            count > 1 ? fmt::format(" (and {})", number_of(count - 1, "more sample")) : "";
        warnings.push_back({where, first + more, hint});
    }
};

/// What to do about another unit: declare it, where the file's format has columns to declare.
std::string other_unit(const Weather& weather, const std::string& problem,
                       const std::string& declaration) {
    return weather.declarable
               ? fmt::format("{}for another unit of the column set it in [weather.columns], as {}",
                             problem, declaration)
               : problem + "this format has a fixed unit: check the conversion of the file";
}

/// Where the sun is to be looked at from: the station, where it is far from the site.
Site place_measured(const Weather& weather, const Site& site) {
    if (!weather.station) return site;
    const Geodetic& station = *weather.station;
    constexpr double near_deg = 1.0;
    const bool near =
        std::abs(station.latitude_deg - site.latitude_deg) < near_deg &&
        std::abs(std::remainder(station.longitude_deg - site.longitude_deg, 360.0)) < near_deg;
    return near ? site : Site{station.latitude_deg, station.longitude_deg, site.height};
}

/// The highest sun of a sample's interval: sine of its elevation, and the elevation.
struct HighestSun {
    double sine = 0.0, elevation_deg = -90.0, distance_au = 1.0;
};
HighestSun highest_sun(const Site& site, Instant middle, double span) {
    HighestSun highest;
    const int points = span > 0.0 ? 5 : 1;
    for (int i = 0; i < points; ++i) {
        const double share = points > 1 ? i / (points - 1.0) - 0.5 : 0.0;
        const SunPosition sun = sun_position(site, later(middle, share * span));
        if (sun.elevation_deg < highest.elevation_deg) continue;
        highest = {std::max(0.0, std::sin(radians(sun.elevation_deg))), sun.elevation_deg,
                   sun.distance_au};
    }
    return highest;
}

bool within(Instant when, Instant begin, Instant end) { return when >= begin && when <= end; }

/// Height at which the standard atmosphere has a pressure [m].
double height_of(double pressure) {
    double low = -500.0, high = 11000.0;
    while (high - low > 1.0) {
        const double middle = 0.5 * (low + high);
        (standard_pressure(middle) > pressure ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// A mean pressure that weather does not explain: at one place a day's mean is within 6 % of the
/// standard atmosphere's, on all but a few days (at the sea 950 to 1060 hPa).
void warn_of_height(const Weather& weather, double mean, const std::string& where,
                    std::vector<Mistake>& warnings) {
    const double share = mean / standard_pressure(weather.height);
    if (share > 0.935 && share < 1.05) return;
    warnings.push_back(
        {where,
         fmt::format("its mean pressure of {:.0f} hPa is that of about {:.0f} m above the sea, but "
                     "the station counts as at {:.0f} m",
                     0.01 * mean, 50.0 * std::round(height_of(mean) / 50.0), weather.height),
         weather.carried ? "set weather.height_m to the station's height (without it, the height "
                           "of the file or of the site counts)"
                         : "check site.elevation_m"});
}

void warn_of_states(const Weather& weather, Instant begin, Instant end, const std::string& where,
                    std::vector<Mistake>& warnings) {
    WarningKind air{other_unit(
        weather, "outside the range measured at the ground: ", "\"air_temperature degC\" or degF")};
    WarningKind wind{other_unit(weather, "", "\"wind_speed km/h\" or kn")};
    WarningKind rain{other_unit(weather, "", "\"rain mm\" per interval")};
    WarningKind sky{"BSRN limits: check for net or upward radiation and the unit"};
    WarningKind over_air{
        "limits are 0.4 to 1 times the black body of the air plus 25 W/m2 (BSRN): check for net or "
        "upward radiation and the unit of the air temperature"};
    const std::string weight = fmt::format(
        "pressure is that at the station, {:.0f} m above the sea (standard atmosphere: {:.0f} Pa), "
        "not reduced to sea level: {}",
        weather.height, standard_pressure(weather.height),
        weather.carried ? "check weather.height_m, and whether the elevation is in feet "
                          "(terrain.height_unit = \"ft\")"
                        : "check site.elevation_m");
    WarningKind pressure{weight};
    double most_humid = -1.0, pressure_sum = 0.0;
    int states = 0;
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        const Instant when = weather.instant[i];
        if (!within(when, begin, end)) continue;
        const Forcing& f = weather.sample[i];
        air.look(f.air.temperature, 183.9, 329.9, when, "air_temperature_K");
        const double usual = standard_pressure(weather.height);
        pressure.look(f.air.pressure, 0.85 * usual, 1.075 * usual, when, "pressure_Pa");
        pressure_sum += f.air.pressure;
        ++states;
        wind.look(f.wind_speed, 0.0, 60.0, when, "wind_speed_m_s");
        rain.look(f.rain_mm_h, 0.0, 305.0, when, "rain_mm_h");
        sky.look(f.longwave_down, 40.0, 700.0, when, "longwave_down_W_m2");
        const double black = stefan_boltzmann * std::pow(f.air.temperature, 4);
        over_air.look(f.longwave_down, 0.4 * black, black + 25.0, when, "longwave_down_W_m2");
        most_humid = std::max(
            most_humid, f.air.vapour_pressure / saturation_vapour_pressure(f.air.temperature));
    }
    if (pressure.count == 0 && states > 0) {
        warn_of_height(weather, pressure_sum / states, where, warnings);
    }
    for (const WarningKind& kind : {air, pressure, wind, rain, sky}) kind.tell(where, warnings);
    if (sky.count == 0 && air.count == 0) over_air.tell(where, warnings);
    if (most_humid >= 0.0 && most_humid < 0.03) {
        warnings.push_back(
            {where, fmt::format("the largest relative_humidity is {:.2g}", most_humid),
             "it is a share, 0 to 1: check whether percent was divided by 100 twice"});
    }
}

std::string hours(double seconds) {
    const int minutes = int(std::lround(std::abs(seconds) / 60.0));
    return minutes % 60 == 0 ? fmt::format("{} h", minutes / 60)
                             : fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

/// What would correct the times, from how far they are off [s].
std::string mend_of(double lag, double longitude_deg, bool declarable) {
    if (!declarable) {
        return fmt::format("check the time zone in the file's header and site.longitude_deg = {:g}",
                           longitude_deg);
    }
    const long quarters = std::lround(lag / 900.0);
    const long minutes = 15 * std::abs(quarters);
    return fmt::format(
        "local stamps marked Z need the offset {}{:02}:{:02} (in the time column, or "
        "[weather.columns] time = \"time {}{:02}:{:02}\"); otherwise check site.longitude_deg = "
        "{:g}{}",
        quarters > 0 ? '-' : '+', minutes / 60, minutes % 60, quarters > 0 ? '-' : '+',
        minutes / 60, minutes % 60, longitude_deg,
        minutes <= 75 ? " ; an hour or less may be due to weather.interval or summer time" : "");
}

/// Light at night, no light by day, and a course that is not the sun's. Returns whether times are
/// uncertain.
bool warn_of_times(const Weather& weather, const Site& site, Instant begin, Instant end,
                   const std::string& where, std::vector<Mistake>& warnings) {
    const Instant middle = later(begin, 0.5 * seconds_between(begin, end));
    const auto lag = sun_lag(weather, site, later(middle, -about), later(middle, about));
    const auto unfit = [](double fit) { return 1.0 - fit * std::abs(fit); };
    const bool off = lag && std::abs(lag->seconds) >= least_lag && lag->fit > 0.85 &&
                     unfit(lag->fit) < 0.6 * unfit(lag->as_it_is);
    std::size_t dark = 0, lit = 0, low_light = 0;
    double brightest = 0.0, highest = 0.0, deepest = 0.0;
    Instant when{};
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        const double light = std::max(std::isnan(weather.sample[i].shortwave_down)
                                          ? weather.sample[i].direct_normal
                                          : weather.sample[i].shortwave_down,
                                      0.0);
        if (!within(weather.instant[i], begin, end) || std::isnan(light)) continue;
        const HighestSun sun = highest_sun(site, weather.instant[i], weather.span_of(i));
        lit += light > 2.0;
        if (sun.elevation_deg > 15.0) {
            ++low_light;
            highest = std::max(highest, sun.elevation_deg);
        }
        if (sun.elevation_deg < -3.0 && light > 25.0) {
            ++dark;
            if (light > brightest) {
                brightest = light;
                deepest = sun.elevation_deg;
                when = weather.instant[i];
            }
        }
    }
    const std::string night =
        dark == 0 ? ""
                  : fmt::format(
                        "{:.0f} W/m2 of sunlight measured at {} with the sun {:.0f} degrees "
                        "below the horizon",
                        brightest, format_instant(when), -deepest);
    if (off) {
        warnings.push_back(
            {where,
             fmt::format("times seem to be {} {}: measured sunlight follows the sun with this "
                         "shift (correlation {:.2f}), not without it ({:.2f}){}",
                         hours(lag->seconds), lag->seconds > 0.0 ? "early" : "late", lag->fit,
                         lag->as_it_is, night.empty() ? "" : "; " + night),
             mend_of(lag->seconds, site.longitude_deg, weather.declarable)});
    } else if (dark > 0) {
        warnings.push_back(
            {where, night + fmt::format(" ({})", number_of(dark, "sample")),
             weather.declarable
                 ? "check the UTC offset of the time column and site.longitude_deg"
                 : "check the time zone in the file's header and site.longitude_deg"});
    } else if (low_light > 2 && lit == 0) {
        warnings.push_back({where,
                            fmt::format("no sunlight was measured from {} to {}, although the sun "
                                        "rises up to {:.0f} degrees",
                                        format_instant(begin), format_instant(end), highest),
                            weather.declarable
                                ? "zeros mean darkness: remove the column to model the sunlight"
                                : "zeros mean darkness: use the format's code for missing values"});
    }
    return off || dark > 0;
}

void warn_of_sunlight(const Weather& weather, const Site& site, Instant begin, Instant end,
                      const std::string& where, std::vector<Mistake>& warnings) {
    WarningKind global{
        other_unit(weather, "above the BSRN limit: ", "\"shortwave_down kJ/m2\" and others")};
    WarningKind direct{"above the solar irradiance: check the unit, and whether it is global"};
    WarningKind diffuse{"above the BSRN limit: check the unit, and whether it is global"};
    WarningKind up{"above the BSRN limit: check the unit"};
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        const Instant when = weather.instant[i];
        if (!within(when, begin, end)) continue;
        const HighestSun sun = highest_sun(site, when, weather.span_of(i));
        const double flux = solar_constant / (sun.distance_au * sun.distance_au);
        const double course = flux * std::pow(sun.sine, 1.2);
        const Forcing& f = weather.sample[i];
        constexpr double least = -50.0;  // [W m⁻²] of a pyranometer that radiates
        global.look(f.shortwave_down, least, 1.5 * course + 100.0, when, "shortwave_down_W_m2");
        direct.look(f.direct_normal, least, flux, when, "direct_normal_W_m2");
        diffuse.look(f.diffuse, least, 0.95 * course + 50.0, when, "diffuse_W_m2");
        up.look(f.shortwave_up, least, 1.2 * course + 50.0, when, "shortwave_up_W_m2");
    }
    for (const WarningKind& kind : {global, direct, diffuse, up}) kind.tell(where, warnings);
}

}  // namespace

std::vector<Mistake> weather_warnings(const Weather& weather, const Site& place, Instant begin,
                                      Instant end, const std::string& where) {
    const Site site = place_measured(weather, place);
    std::vector<Mistake> warnings = weather.warnings;
    warn_of_states(weather, begin, end, where, warnings);
    if (!warn_of_times(weather, site, begin, end, where, warnings)) {
        warn_of_sunlight(weather, site, begin, end, where, warnings);
        for (Mistake& of : light_contradictions(weather, site, begin, end, where)) {
            warnings.push_back(std::move(of));
        }
    }
    return warnings;
}

}  // namespace diurna
