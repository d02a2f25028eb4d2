#include "terrain/place/celestial.hpp"

#include <erfa.h>
#include <erfam.h>

#include <array>
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

JulianDate terrestrial_time(Instant instant) {
    return julian_date(instant).later(leap_seconds(instant) + ERFA_TTMTAI);
}

/// From the celestial frame (GCRS) to that of the pole and origin of date (CIRS).
Eigen::Vector3d of_date(const JulianDate& tt, double celestial[3]) {
    double to_intermediate[3][3];
    eraC2i00b(tt.day, tt.fraction, to_intermediate);
    Eigen::Vector3d place;
    eraRxp(to_intermediate, celestial, place.data());
    return place;
}

/// From the frame of date to the one that turns with the earth. No polar motion.
Eigen::Vector3d turned_with_earth(const Eigen::Vector3d& place, Instant instant) {
    const JulianDate utc = julian_date(instant);
    const double angle = eraEra00(utc.day, utc.fraction);
    const double c = std::cos(angle), s = std::sin(angle);
    return {c * place.x() + s * place.y(), c * place.y() - s * place.x(), place.z()};
}

/// Apparent position of the sun in the frame of date [au].
Eigen::Vector3d sun_of_date(const JulianDate& tt) {
    double heliocentric[2][3], barycentric[2][3];
    eraEpv00(tt.day, tt.fraction, heliocentric, barycentric);

    double towards_sun[3], distance = 0.0, opposite[3];
    eraSxp(-1.0, heliocentric[0], opposite);
    eraPn(opposite, &distance, towards_sun);

    // Light of the sun arrives aberrated by the earth's motion: 20.5″.
    double velocity[3], apparent[3];
    eraSxp(ERFA_AULT / ERFA_DAYSEC, barycentric[1], velocity);
    eraAb(towards_sun, velocity, distance, std::sqrt(1.0 - eraPdp(velocity, velocity)), apparent);
    return distance * of_date(tt, apparent);
}

/// sun_of_date() at multiples of half a day of terrestrial time, the last few that a thread used.
const Eigen::Vector3d& sun_knot(long long half_days) {
    struct Knot {
        long long half_days = -1;
        Eigen::Vector3d place;
    };
    thread_local std::array<Knot, 64> knots;
    Knot& knot = knots[static_cast<std::size_t>(half_days & 63)];
    if (knot.half_days != half_days) {
        knot = {half_days, sun_of_date({0.5 * static_cast<double>(half_days), 0.0})};
    }
    return knot.place;
}

}  // namespace

Eigen::Vector3d sun_from_earth(Instant instant) {
    const JulianDate tt = terrestrial_time(instant);
    // Julian dates of days end in .5, so that twice a day is whole.
    const double after = 2.0 * tt.fraction, begin = std::floor(after), x = after - begin;
    const long long k = std::llround(2.0 * tt.day) + static_cast<long long>(begin);
    // Lagrange through −1, 0, 1, 2.
    const Eigen::Vector3d place = -x * (x - 1.0) * (x - 2.0) / 6.0 * sun_knot(k - 1) +
                                  (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0 * sun_knot(k) -
                                  (x + 1.0) * x * (x - 2.0) / 2.0 * sun_knot(k + 1) +
                                  (x + 1.0) * x * (x - 1.0) / 6.0 * sun_knot(k + 2);
    return turned_with_earth(place, instant);
}

Eigen::Vector3d moon_from_earth(Instant instant) {
    const JulianDate tt = terrestrial_time(instant);
    double moon[2][3];
    eraMoon98(tt.day, tt.fraction, moon);
    return turned_with_earth(of_date(tt, moon[0]), instant);
}

Eigen::Vector3d from_site(const Site& site, const Eigen::Vector3d& place) {
    Eigen::Vector3d observer;
    eraGd2gc(ERFA_WGS84, radians(site.longitude_deg), radians(site.latitude_deg), site.height,
             observer.data());
    return place - observer / ERFA_DAU;
}

Eigen::Vector3d east_north_up(const Site& site, const Eigen::Vector3d& vector) {
    const double longitude = radians(site.longitude_deg), latitude = radians(site.latitude_deg);
    const double sin_lat = std::sin(latitude), cos_lat = std::cos(latitude);
    const double sin_lon = std::sin(longitude), cos_lon = std::cos(longitude);
    const double east = -sin_lon * vector.x() + cos_lon * vector.y();
    const double outward = cos_lon * vector.x() + sin_lon * vector.y();
    const double north = cos_lat * vector.z() - sin_lat * outward;
    const double up = sin_lat * vector.z() + cos_lat * outward;
    return {east, north, up};
}

}  // namespace diurna
