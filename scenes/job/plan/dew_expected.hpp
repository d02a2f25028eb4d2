#pragma once

#include <algorithm>
#include <cmath>

#include "materials/air/moist_air.hpp"
#include "materials/base/units.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

namespace dew {

inline constexpr double worth = 0.3;           // [K] as thermal/solve/point_facets.hpp has it
inline constexpr double psychrometric = 66.0;  // [Pa K⁻¹] near the ground
inline constexpr double made_up_below = 0.5;   // of the loss, replaced by heat from below
inline constexpr double still_air = 4.0, by_wind = 4.0;  // [W m⁻² K⁻¹], [J m⁻³ K⁻¹]

inline double longwave_from_sky(const Forcing& row) {
    if (!std::isnan(row.longwave_down)) return row.longwave_down;
    const double air = row.air.temperature, cloud = row.cloud_fraction;
    const double clear = 1.24 * std::pow(0.01 * row.air.vapour_pressure / air, 1.0 / 7.0);
    const double clouds = std::isnan(cloud) ? 1.0 : 1.0 + 0.22 * cloud * cloud;
    return std::min(1.0, clear * clouds) * stefan_boltzmann * std::pow(air, 4);
}

/// [K] by which dew warms such a surface; negative without dew.
inline double warming(const Forcing& row) {
    const double air = row.air.temperature;
    const double film = still_air + by_wind * row.wind_speed;
    const double loses = film + 4.0 * stefan_boltzmann * std::pow(air, 3);
    const double lost = stefan_boltzmann * std::pow(air, 4) - longwave_from_sky(row);
    const double surface = air - (1.0 - made_up_below) * std::max(0.0, lost) / loses;
    const double vapour = row.air.vapour_pressure - saturation_vapour_pressure(surface);
    return film * vapour / psychrometric / loses;
}

}  // namespace dew

/// Whether dew or hoar is expected on open dry surfaces at any row of a series between two
/// instants: whether a level black surface that loses heat to the sky by night, with half of that
/// replaced from below, would be warmed by 0.3 K or more by condensation. Uses only the rows, for
/// the estimate of a plan; the solver decides facet by facet (thermal/solve/dew_need).
///
/// Longwave that was not measured: Brutsaert (1975), clouds by 1 + 0.22 n² (Sugita & Brutsaert
/// 1993).
inline bool dew_expected(const Weather& weather, const Site& site, Instant from, Instant to) {
    for (std::size_t i = 0; i < weather.instant.size(); ++i) {
        const Instant when = weather.instant[i];
        if (when < from || when > to || dew::warming(weather.sample[i]) < dew::worth) continue;
        if (sun_position(site, when).elevation_deg < 0.0) return true;
    }
    return false;
}

}  // namespace diurna
