#include "thermal/point/point_weather.hpp"

#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/surface/standing_water.hpp"
#include "thermal/weather/sky_shape.hpp"

namespace diurna {

PointWeather::PointWeather(const PointJob& job)
    : job_(job),
      series_(job.weather, job.site, job.elevation, job.clear_sky, job.start, job.end),
      sun_(job.site),
      normal_(direction(job.aspect_deg, 90.0 - job.slope_deg)),
      rain_share_(job.surface.flight ? 0.0 : rain_share(normal_.z(), 1.0)) {
    const SkyVector sky = plane_behind_ring(normal_.cast<float>(), job.sky_view);
    open_ = open_sky(sky);
    open_.view = job.sky_view;
    if (job.clear_sky.longwave_by_direction) tilted_ = tilted_sky_excess(sky);
}

PointForcing PointWeather::operator()(Instant when) {
    const Forcing forcing = series_.weather().at(when);
    const SkyState sky = series_.at(when, sun_.at(when));
    const double hidden = 1.0 - job_.sky_view;
    PointForcing f{.air = forcing.air,
                   .wind_speed = forcing.wind_speed,
                   .rain_mm_h = rain_share_ * forcing.rain_mm_h,
                   .albedo = sky.albedo,
                   .longwave_in = job_.sky_view * sky.longwave_down + tilted_ * sky.tilted_longwave,
                   .own_view = hidden};
    if (std::isnan(sky.plane_of_array)) {
        f.sunlight = facet_sunlight(sky, normal_.dot(sky.to_sun), 1.0, open_);
        f.own_light = hidden * sky.global_horizontal();
    } else {
        f.sunlight = sky.plane_of_array;
    }
    if (job_.surface.flight) f.wind_speed = job_.surface.flight->speed;
    return f;
}

}  // namespace diurna
