#pragma once

#include <array>

#include "terrain/place/site.hpp"
#include "terrain/place/sun.hpp"
#include "terrain/place/sun_path.hpp"
#include "thermal/weather/clear_sky.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// The clear sky over a place at an instant.
struct ClearMoment {
    SunPosition sun;  // refracted
    double sine;      // of its elevation; below zero when down
    double top;       // [W m⁻²] above the air on a plane facing the sun
    Sunlight light;
};

/// The clear sky along a series of weather: the reference for its measured sunlight.
class ClearCourse {
 public:
    ClearCourse(const Weather& weather, const Site& site, double elevation, const ClearSky& clear)
        : weather_(weather), site_(site), elevation_(elevation), clear_(clear), path_(site) {}

    /// haze  factor on the clear sky's optical depth of aerosol (on Linke's turbidity above 1)
    ClearMoment at(Instant when, double haze = 1.0);

    /// Apparent solar time [h] of a sun, noon at 12.
    double solar_hour(const SunPosition& sun) const;

    /// The sunlit part of [from, to] in seconds since an origin, to half a second; empty (from >
    /// to) in the dark. Only one part: a polar noon within a longer interval is separate.
    std::array<double, 2> sunlit(Instant origin, double from, double to);

 private:
    ClearSky with_haze(double haze) const;

    const Weather& weather_;
    const Site& site_;
    double elevation_;
    const ClearSky& clear_;
    SunPath path_;
};

/// Sums over moments of an interval under a clear sky.
struct ClearSums {
    double seconds = 0.0;
    double top = 0.0, top_normal = 0.0;     // [J m⁻²] above the air, horizontal; facing the sun
    double direct = 0.0, horizontal = 0.0;  // [J m⁻²] of direct light, facing the sun; horizontal
    double diffuse = 0.0;                   // [J m⁻²]

    void add(const ClearMoment& at, double weight);
    double global() const { return horizontal + diffuse; }
    double mean_sine() const { return top_normal > 0.0 ? top / top_normal : 0.0; }
};

}  // namespace diurna
