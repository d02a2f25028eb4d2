#pragma once

#include <optional>
#include <vector>

#include "materials/matter/material.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "thermal/point/calibration.hpp"
#include "thermal/weather/sky_state.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// History before the span: none (the given start), its first day repeated, or the span itself. The
/// first day is repeated without the trend of its air and sky from end to end, because the change
/// due to a weather front belongs to that day only.
enum class SpinUp { none, first_day, periodic };

/// A temperature in the ground.
struct SoilPoint {
    double depth;        // [m]
    double temperature;  // [K]
};

/// One facet under a series of weather: the content of a column file
/// (thermal/point/point_job_file.hpp).
struct PointJob {
    Site site;
    double elevation = 0.0;   // [m] above the sea
    double slope_deg = 0.0;   // 0 to 180
    double aspect_deg = 180;  // direction it faces, clockwise from north
    double sky_view = 1.0;    // 0 to 1; the rest is ground of its own kind, at its temperature
    double height = 0.0;      // [m] above the ground, for the wind; 0: as the wind's
    ThermalSurface surface;
    Weather weather;
    ClearSky clear_sky;
    Instant start{}, end{};
    double utc_offset = 0.0;  // [s] that the clock of schedules is ahead of UTC, as start has it
    SpinUp spin_up = SpinUp::first_day;
    double step = 1800.0;                       // output cadence [s]
    double longest_step = 600.0;                // of the integration [s]
    double tolerance = 0.002;                   // [K] per step, from step doubling
    double initial_temperature = not_measured;  // [K] uniform, for SpinUp::none
    /// Ground at the start, for SpinUp::none: linear between ascending depths, constant outside.
    std::vector<SoilPoint> initial_profile;
    double depth = 0.0;  // [m] of PointRow::depth_temperature, within the column's nodes
    std::optional<Calibration> calibrate{};  // for thermal/point/calibrate.hpp alone
};

}  // namespace diurna
