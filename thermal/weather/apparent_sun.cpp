#include "thermal/weather/apparent_sun.hpp"

#include "materials/base/units.hpp"

namespace diurna {

SunPosition apparent_sun(const SunPosition& geometric, const AirState& air, double elevation) {
    const double pressure = air.pressure > 0.0 ? air.pressure : standard_pressure(elevation);
    return refracted(geometric, pressure / 100.0, celsius(air.temperature));
}

SunPosition apparent_sun(const Site& site, double elevation, const Weather& weather, Instant when) {
    return apparent_sun(sun_position(site, when), weather.air_at(when), elevation);
}

}  // namespace diurna
