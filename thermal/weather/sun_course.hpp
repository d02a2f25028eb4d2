#pragma once

#include <cstddef>
#include <vector>

#include "terrain/place/site.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/weather/clear_sky.hpp"
#include "thermal/weather/separation.hpp"
#include "thermal/weather/sun_rows.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Ratio of light to the clear sky's through the sunlit part of an interval, x = 0 to 1:
/// k(x) = clamp(first + x (last − first) + 4 x (1 − x) bulge, 0, most).
struct SunFactor {
    double first = 0.0, last = 0.0, bulge = 0.0, most = 50.0;
    double at(double x) const;
};

/// The course of sunlight through rows that are means over intervals (or values at instants).
///
/// Within an interval light follows the clear sky's direct and diffuse light, times a clearness
/// that is linear from interval to interval plus a bulge such that the interval's integral
/// equals its mean (to 1e-9 by the quadrature below): no light with the sun down, and no peaks
/// from dividing a mean by the sine of a low sun. Direct light stays below 1.1 of the clear
/// sky's; the excess (reflections by cloud edges) counts as diffuse. Measured direct light is
/// used even if its mean exceeds that. For rows at instants the clearness is linear between
/// them.
///
/// Measured values take precedence (thermal/weather/sun_rows.hpp). Rows with neither direct,
/// diffuse nor global light are left to the clear sky and the cloud (`at` returns NaN).
class SunCourse {
 public:
    /// Uses the rows needed from `from` to `to`; the others are skipped.
    SunCourse(const Weather& weather, const Site& site, double elevation, const ClearSky& clear,
              Instant from, Instant to);

    /// Direct and diffuse sunlight, NaN without a row. `clear` is clear_sunlight() then.
    Sunlight at(Instant when, const Sunlight& clear) const;

    /// Global sunlight over the clear sky's, by row of the weather; NaN: unknown, or a low sun
    /// (mean elevation below 8°).
    const std::vector<double>& clearness() const { return clearness_; }
    const SunCourseReport& report() const { return report_; }

 private:
    struct Stretch {
        double from = 0.0, to = 0.0;          // [s] since `origin_`
        double lit_from = 0.0, lit_to = 0.0;  // its sunlit part
        SunFactor direct{}, diffuse{};
        bool known_direct = false, known_diffuse = false;
        bool plain = false;  // the factors are light itself [W m⁻²]
    };
    void join(std::vector<SunRow> rows);
    void connect(const std::vector<SunRow>& rows);

    Instant origin_{};
    std::vector<Stretch> stretch_;  // ascending
    std::vector<double> clearness_;
    SunCourseReport report_;
};

}  // namespace diurna
