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

/// The weather at one instant. Fluxes are NaN where nobody measured them; they are then modelled
/// from air and cloud (thermal/weather/sky_state.hpp). A measured value always wins.
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

/// On the straight line from one to the other, at a share of the way; NaN unless both are measured.
Forcing between(const Forcing& a, const Forcing& b, double share);

/// What a time stamp says of its row: the mean over the interval that starts or ends there, or the
/// value at that instant.
enum class Stamp { start, end, instant };

/// A series of weather, linear between its samples and constant beyond its ends; sunlight has a
/// course of its own (thermal/weather/sun_course.hpp), rain falls evenly through its interval.
///
/// A mean over an interval counts as the value at the middle of the interval, so a series of means
/// keeps its phase. A flux is NaN between two samples unless both are measured.
struct Weather {
    std::vector<Instant> instant;  // ascending; never empty
    std::vector<Forcing> sample;   // as many
    std::vector<double> span{};    // [s] (sample) of the interval, about `instant`, that a sample
                                   // is the mean of; 0, or the whole empty: its value there
    double wind_height = 10.0;     // [m] above the ground (above zero-plane displacement)
    double air_height = 2.0;       // [m] of temperature and humidity
    double height = 0.0;           // [m] above the sea, of the ground where it was measured
    std::string note{};            // what is absent and therefore modelled, one line; or empty
    std::vector<Mistake> warnings{};    // what is implausible of the file or its station
    std::optional<Geodetic> station{};  // where it was measured, if the file says so
    /// Whether the file's columns may be declared in [weather.columns], its stamps in
    /// weather.interval: what warnings advise.
    bool declarable = true;
    bool carried = true;  // to the height of each facet, from that of weather.height_m: scenes
    /// The air above it, for scenes that name none; null: of the season, by all its rows.
    std::shared_ptr<const Profile> above{};
    /// How its scattered sunlight is spread over the sky; null: by perez_split().
    std::shared_ptr<const SkySpreads> spreads{};
    /// Its light where heights differ by more than formulas say; null: nowhere.
    std::shared_ptr<const LightByHeight> by_height{};

    Forcing at(Instant when) const;
    AirState air_at(Instant when) const;
    double span_of(std::size_t i) const { return span.empty() ? 0.0 : span[i]; }
};

}  // namespace diurna
