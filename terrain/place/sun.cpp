#include "terrain/place/sun.hpp"

#include <erfa.h>
#include <erfam.h>

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

/// A Julian date in two parts, as ERFA takes it: day and fraction, so that no digit is lost.
struct JulianDate {
    double day, fraction;
    JulianDate later(double seconds) const { return {day, fraction + seconds / ERFA_DAYSEC}; }
};

JulianDate julian_date(Instant instant) {
    const auto midnight = std::chrono::floor<std::chrono::days>(instant);
    const double epoch_mjd = 40587.0;  // 1970-01-01
    return {ERFA_DJM0 + epoch_mjd + static_cast<double>(midnight.time_since_epoch().count()),
            std::chrono::duration<double>(instant - midnight).count() / ERFA_DAYSEC};
}

/// TAI − UTC [s]: the leap seconds so far.
double leap_seconds(Instant instant) {
    const auto midnight = std::chrono::floor<std::chrono::days>(instant);
    const std::chrono::year_month_day date(midnight);
    double difference = 0.0;
    eraDat(static_cast<int>(date.year()), static_cast<int>(static_cast<unsigned>(date.month())),
           static_cast<int>(static_cast<unsigned>(date.day())),
           std::chrono::duration<double>(instant - midnight).count() / ERFA_DAYSEC, &difference);
    return difference;
}

/// Geocentric apparent place of the sun [au] in the terrestrial frame. UT1 is taken as UTC: they
/// differ by less than 0.9 s, 0.004° of hour angle and, on average over a year, much less.
Eigen::Vector3d sun_in_terrestrial_frame(Instant instant) {
    const JulianDate utc = julian_date(instant);
    const JulianDate tt = utc.later(leap_seconds(instant) + ERFA_TTMTAI);

    double heliocentric[2][3], barycentric[2][3];
    eraEpv00(tt.day, tt.fraction, heliocentric, barycentric);

    double towards_sun[3], distance = 0.0, opposite[3];
    eraSxp(-1.0, heliocentric[0], opposite);
    eraPn(opposite, &distance, towards_sun);

    // Light of the sun arrives aberrated by the earth's motion: 20.5″.
    double velocity[3], apparent[3];
    eraSxp(ERFA_AULT / ERFA_DAYSEC, barycentric[1], velocity);
    eraAb(towards_sun, velocity, distance, std::sqrt(1.0 - eraPdp(velocity, velocity)), apparent);

    double to_intermediate[3][3], to_terrestrial[3][3], no_polar_motion[3][3];
    eraC2i00b(tt.day, tt.fraction, to_intermediate);
    eraIr(no_polar_motion);
    eraC2tcio(to_intermediate, eraEra00(utc.day, utc.fraction), no_polar_motion, to_terrestrial);

    Eigen::Vector3d place;
    eraRxp(to_terrestrial, apparent, place.data());
    return distance * place;
}

}  // namespace

SunPosition sun_position(const Site& site, Instant instant) {
    const double longitude = radians(site.longitude_deg), latitude = radians(site.latitude_deg);
    Eigen::Vector3d observer;
    eraGd2gc(ERFA_WGS84, longitude, latitude, site.height, observer.data());

    const Eigen::Vector3d sun = sun_in_terrestrial_frame(instant) - observer / ERFA_DAU;
    const double sin_lat = std::sin(latitude), cos_lat = std::cos(latitude);
    const double sin_lon = std::sin(longitude), cos_lon = std::cos(longitude);
    const double east = -sin_lon * sun.x() + cos_lon * sun.y();
    const double outward = cos_lon * sun.x() + sin_lon * sun.y();
    const double north = cos_lat * sun.z() - sin_lat * outward;
    const double up = sin_lat * sun.z() + cos_lat * outward;
    SunPosition position = sun_at({east, north, up});
    position.distance_au = sun.norm();  // without the turn's rounding
    return position;
}

SunPosition sun_at(const Eigen::Vector3d& place) {
    double azimuth_deg = degrees(std::atan2(place.x(), place.y()));
    if (azimuth_deg < 0.0) azimuth_deg += 360.0;
    return {azimuth_deg, degrees(std::atan2(place.z(), std::hypot(place.x(), place.y()))),
            place.norm()};
}

SunPosition sun_position(const Site& site, Instant instant, double pressure_hPa,
                         double temperature_C) {
    return refracted(sun_position(site, instant), pressure_hPa, temperature_C);
}

SunPosition refracted(SunPosition sun, double pressure_hPa, double temperature_C) {
    const double upper_limb_at_horizon_deg = -0.26667 - 0.5667;
    if (sun.elevation_deg >= upper_limb_at_horizon_deg) {
        const double e = sun.elevation_deg;
        sun.elevation_deg += (pressure_hPa / 1010.0) * (283.0 / (273.0 + temperature_C)) * 1.02 /
                             (60.0 * std::tan(radians(e + 10.3 / (e + 5.11))));
    }
    return sun;
}

Eigen::Vector3d sun_direction(const SunPosition& sun) {
    return direction(sun.azimuth_deg, sun.elevation_deg);
}

}  // namespace diurna
