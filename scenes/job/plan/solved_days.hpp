#pragma once

#include "scenes/job/input/scene.hpp"
#include "terrain/place/site.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Days that the heat balance solves for a scene's span (thermal/solve/solve_span.hpp).
struct SolvedDays {
    double repeated = 0.0;    // solved until it repeats: 1, or 0 from a state or a mean day
    bool leads_in = false;    // it lies before the span
    double more = 0.0;        // gone through once, those before the span included
    double steps_of_day = 0;  // ends included
    // Days, their steps, and those with the sun up; each further day counts as the part of a
    // repeated one that it takes (PlanCosts::heat_day_more).
    double days = 0.0, steps = 0.0, sunlit = 0.0;
};

/// Whether the sun is above the horizon, refraction and the disc's upper edge included: 0.57 and
/// 0.27 degrees.
bool sun_is_up(const Site& site, Instant when);

/// - moves: whether objects move within the span
SolvedDays solved_days(const Scene& scene, const Site& site, const Weather& weather, bool moves);

}  // namespace diurna
