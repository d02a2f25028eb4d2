#include "thermal/weather/clear_course.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/weather/apparent_sun.hpp"

namespace diurna {

ClearSky ClearCourse::with_haze(double haze) const {
    ClearSky sky = clear_;
    sky.aerosol_380nm *= haze;
    sky.aerosol_500nm *= haze;
    sky.linke_turbidity = 1.0 + haze * (sky.linke_turbidity - 1.0);
    return sky;
}

ClearMoment ClearCourse::at(Instant when, double haze) {
    const AirState air = weather_.air_at(when);
    const SunPosition sun = apparent_sun(path_.at(when), air, elevation_);
    const double sine = sun_direction(sun).z();
    Sunlight light{0.0, 0.0};
    if (sine > 0.0) light = clear_sunlight(sun, air, elevation_, with_haze(haze));
    return {.sun = sun,
            .sine = sine,
            .top = solar_constant / (sun.distance_au * sun.distance_au),
            .light = light};
}

double ClearCourse::solar_hour(const SunPosition& sun) const {
    const Eigen::Vector3d to = sun_direction(sun);
    const double latitude = radians(site_.latitude_deg);
    const double south = to.z() * std::cos(latitude) - to.y() * std::sin(latitude);
    return 12.0 + degrees(std::atan2(-to.x(), south)) / 15.0;
}

std::array<double, 2> ClearCourse::sunlit(Instant origin, double from, double to) {
    const auto sine = [&](double s) { return at(later(origin, s)).sine; };
    const int parts = std::clamp(static_cast<int>(std::ceil((to - from) / 900.0)), 2, 200);
    double first = to, last = from;
    for (int i = 0; i <= parts; ++i) {
        const double s = from + (to - from) * i / parts;
        if (sine(s) <= 0.0) continue;
        first = std::min(first, s);
        last = std::max(last, s);
    }
    if (first > last) return {1.0, 0.0};
    const double width = (to - from) / parts;
    const auto edge = [&](double lit, double dark) {
        while (std::abs(lit - dark) > 0.5) {
            const double middle = 0.5 * (lit + dark);
            (sine(middle) > 0.0 ? lit : dark) = middle;
        }
        return lit;
    };
    if (first > from) first = edge(first, first - width);
    if (last < to) last = edge(last, last + width);
    return {first, last};
}

void ClearSums::add(const ClearMoment& at, double weight) {
    const double up = std::max(0.0, at.sine);
    seconds += weight;
    top += weight * at.top * up;
    top_normal += weight * at.top;
    direct += weight * at.light.direct_normal;
    horizontal += weight * at.light.direct_normal * up;
    diffuse += weight * at.light.diffuse_horizontal;
}

}  // namespace diurna
