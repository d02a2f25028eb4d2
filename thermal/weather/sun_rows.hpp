#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "thermal/weather/clear_course.hpp"
#include "thermal/weather/separation.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Treatment of a series' sunlight, for the report.
struct SunCourseReport {
    std::size_t separated = 0;    // rows of only global sun, split by a model
    std::size_t in_the_dark = 0;  // rows over 10 W/m² with the sun down: diffuse light
    double brightest_dark = 0.0;  // [W m⁻²] of those
    std::size_t capped = 0;       // rows with direct light over 1.1 of a clear sky's
    double most_capped = 0.0;     // [W m⁻²] largest excess of those, on a horizontal plane
};

/// The report in one line; empty if there is nothing to report.
std::string tell(const SunCourseReport& report);

/// A moment of a row's sunlit part under the clear sky, a point of a quadrature.
struct SunNode {
    double x, weight;              // of the sunlit part, 0 to 1; [s]
    double direct, sine, diffuse;  // [W m⁻²], of the sun's elevation, [W m⁻²]
};

/// A row of the weather as light relative to the clear sky's.
struct SunRow {
    std::size_t sample = 0;
    double from = 0.0, to = 0.0, lit_from = 0.0, lit_to = 0.0;  // [s] since the series' first row
    bool known_direct = false, known_diffuse = false, lit = false;
    bool horizontal = false;                     // the direct light's sum is that on the horizontal
    double direct = 0.0, diffuse = 0.0;          // over the clear sky's
    bool rest = false;                           // the diffuse light is global minus direct
    double most = 1.1;                           // of `direct` at any instant
    double direct_normal = 0.0, skylight = 0.0;  // [W m⁻²] at its instant; in the dark its mean
    double clearness;  // global over the clear sky's; NaN: unknown or a low sun
    ClearSums clear{};
    std::vector<SunNode> node{};

    double direct_weight(const SunNode& n) const {
        return n.weight * n.direct * (horizontal ? n.sine : 1.0);
    }
    double direct_sum() const { return horizontal ? clear.horizontal : clear.direct; }
};

/// The light of the rows from `first` to before `last`. Measured values take
/// precedence: direct and diffuse each separately; global with one of them
/// gives the other; all three are made to add up (diffuse takes the
/// difference); global alone is split by `separation`, and as in a clear sky if
/// as bright as one. On days brighter than the clear sky the haze is reduced,
/// to a twentieth at 8 %, the whole effect of haze. Direct light is limited to
/// 1.1 of the clear sky's, the rest is diffuse; measured direct light is not
/// limited.
std::vector<SunRow> sun_rows(const Weather& weather, ClearCourse& clear, Separation separation,
                             std::size_t first, std::size_t last, SunCourseReport& report);

}  // namespace diurna
