#include "terrain/place/local_time.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "materials/base/units.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

std::string format_local(Instant instant, double utc_offset) {
    const auto minutes = std::lround(utc_offset / 60.0);
    std::string text = format_instant(later(instant, 60.0 * double(minutes)));
    text.pop_back();  // the Z
    const long size = std::labs(minutes);
    return fmt::format("{}{}{:02}:{:02}", text, minutes < 0 ? '-' : '+', size / 60, size % 60);
}

double solar_time_h(const Site& site, Instant instant) {
    const Eigen::Vector3d to_sun = sun_direction(sun_position(site, instant));
    const double latitude = radians(site.latitude_deg);
    const double along_meridian = to_sun.z() * std::cos(latitude) - to_sun.y() * std::sin(latitude);
    const double hour_angle = std::atan2(-to_sun.x(), along_meridian);  // westward
    const double hours = 12.0 + hour_angle * 12.0 / M_PI;
    return hours >= 24.0 ? hours - 24.0 : hours;
}

std::string format_solar_time(const Site& site, Instant instant) {
    const auto minutes = std::lround(60.0 * solar_time_h(site, instant)) % (24 * 60);
    return fmt::format("{:02}:{:02}", minutes / 60, minutes % 60);
}

}  // namespace diurna
