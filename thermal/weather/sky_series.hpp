#pragma once

#include <vector>

#include "thermal/weather/sky_state.hpp"
#include "thermal/weather/sun_course.hpp"

namespace diurna {

/// The sky over one place at any instant of a series of weather: sunlight by its course, longwave
/// and cloud as measured or modelled. Used for scenes, single facets and the camera's air.
class SkySeries {
 public:
    /// From the first to the last instant that will be needed. Cloud that was not observed is
    /// inferred from measured sunlight over the clear sky's (Crawford & Duchon 1999: 1 − G/G_clear
    /// for a sun above 8°, held through the night), over the span and a day at either end.
    SkySeries(Weather weather, const Site& site, double elevation, const ClearSky& clear,
              Instant from, Instant to);

    /// sun  without refraction
    SkyState at(Instant when, const SunPosition& sun) const;
    /// Longwave, temperatures and everything else that needs no sun: faster.
    SkyState dark(Instant when) const;

    const Weather& weather() const { return weather_; }
    /// Treatment of measured sunlight; also reported in weather().note.
    const SunCourseReport& sunlight() const { return course_.report(); }

 private:
    void infer_cloud();
    double albedo_at(Instant when) const;
    SkyState placed(Instant when, SkyState sky) const;

    Weather weather_;
    double elevation_;
    ClearSky clear_;
    SunCourse course_;
    std::vector<double> albedo_;  // (sample) measured up over down; NaN: not known
};

}  // namespace diurna
