#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "materials/air/moist_air.hpp"
#include "materials/base/error.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

struct Profile;
struct LightByHeight;
struct SkySpreads;

inline constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// The weather at one instant. Fluxes are NaN if they were not measured; they are then modelled
/// from air and cloud (thermal/weather/sky_state.hpp). Measured values take precedence.
struct Forcing {
    AirState air;
    double wind_speed = 1.0;               // [m s⁻¹] at the weather's wind_height
    double rain_mm_h = 0.0;                // [mm h⁻¹]
    double cloud_fraction = not_measured;  // 0 to 1; NaN: clear, or inferred from measured sun
    double shortwave_down = not_measured;  // global, on the horizontal [W m⁻²]
    double direct_normal = not_measured;   // beam, on a plane facing the sun [W m⁻²]
    double diffuse = not_measured;         // sky light on the horizontal [W m⁻²]
    double shortwave_up = not_measured;    // reflected by the ground [W m⁻²]
    double plane_of_array = not_measured;  // global, on the facet itself [W m⁻²]
    double longwave_down = not_measured;   // [W m⁻²]
};

/// Linear interpolation between the two at a share of the interval; NaN unless both are measured.
Forcing between(const Forcing& a, const Forcing& b, double share);

/// What a time stamp means for its row: the mean over the interval that starts or ends there, or
/// the value at that instant.
enum class Stamp { start, end, instant };

/// A series of weather, linear between its samples and constant outside; sunlight has its own
/// course (thermal/weather/sun_course.hpp), rain is constant over its interval.
///
/// A mean over an interval counts as the value at the middle of the interval, so a series of means
/// keeps its phase. A flux is NaN between two samples unless both are measured.
struct Weather {
    std::vector<Instant> instant;  // ascending; never empty
    std::vector<Forcing> sample;   // same length
    std::vector<double> span{};    // [s] (sample) of the interval, centred on `instant`, of which
                                   // it is the mean; 0, or all empty: an instantaneous value
    double wind_height = 10.0;     // [m] above the ground (above zero-plane displacement)
    double air_height = 2.0;       // [m] of temperature and humidity
    double height = 0.0;           // [m] above the sea, of the ground at the station
    std::string note{};            // missing values that are modelled, one line; or empty
    std::vector<Mistake> warnings{};    // implausible values of the file or its station
    std::optional<Geodetic> station{};  // the file's position of the station, if it has one
    /// Whether the file's columns can be declared in [weather.columns], and its stamps in
    /// weather.interval: used in warnings.
    bool declarable = true;
    bool carried = true;  // converted from weather.height_m to each facet's height: scenes
    /// The air above it, for scenes without a profile; null: seasonal, from all its rows.
    std::shared_ptr<const Profile> above{};
    /// Distribution of its scattered sunlight over the sky; null: by perez_split().
    std::shared_ptr<const SkySpreads> spreads{};
    /// Its light where heights differ by more than formulas say; null: nowhere.
    std::shared_ptr<const LightByHeight> by_height{};

    Forcing at(Instant when) const;
    AirState air_at(Instant when) const;
    double span_of(std::size_t i) const { return span.empty() ? 0.0 : span[i]; }
};

}  // namespace diurna
