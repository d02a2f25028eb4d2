#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "materials/air/moist_air.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/material.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/weather/repeated_day.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

namespace dew {

inline constexpr double worth = 0.3;           // [K] as thermal/solve/point_facets.hpp has it
inline constexpr double psychrometric = 66.0;  // [Pa K⁻¹] near the ground
inline constexpr double half_made_up = 20e3;  // [J m⁻² K⁻¹] below which made_up is under a half
inline constexpr double still_air = 4.0, by_wind = 4.0;  // [W m⁻² K⁻¹], [J m⁻³ K⁻¹]

inline double longwave_from_sky(const Forcing& row) {
    if (!std::isnan(row.longwave_down)) return row.longwave_down;
    const double air = row.air.temperature, cloud = row.cloud_fraction;
    const double clear = 1.24 * std::pow(0.01 * row.air.vapour_pressure / air, 1.0 / 7.0);
    const double clouds = std::isnan(cloud) ? 1.0 : 1.0 + 0.22 * cloud * cloud;
    return std::min(1.0, clear * clouds) * stefan_boltzmann * std::pow(air, 4);
}

/// [J m⁻² K⁻¹] down to where a daily wave is damped to 1/e.
inline double stored(std::span<const Layer> layers) {
    double heat = 0.0, deep = 0.0;  // in depths of damping
    for (const Layer& one : layers) {
        const double capacity = one.density * one.heat_capacity;
        const double damping =
            std::sqrt(one.conductivity / capacity * seconds_of_day / std::numbers::pi);
        const double share = std::min(one.thickness / damping, 1.0 - deep);
        heat += capacity * damping * share;
        deep += share;
    }
    return heat;
}

/// [K] by which dew warms a surface; negative without dew.
///
/// - made_up: how much its temperature is that of the heat below, 0 to 1
/// - mean_air: [K] which the heat below has
inline double warming(const Forcing& row, double made_up, double mean_air) {
    const double air = row.air.temperature;
    const double film = still_air + by_wind * row.wind_speed;
    const double loses = film + 4.0 * stefan_boltzmann * std::pow(air, 3);
    const double lost = stefan_boltzmann * std::pow(air, 4) - longwave_from_sky(row);
    const double alone = air - std::max(0.0, lost) / loses;
    const double surface = (1.0 - made_up) * alone + made_up * mean_air;
    const double vapour = row.air.vapour_pressure - saturation_vapour_pressure(surface);
    return film * vapour / psychrometric / loses;
}

}  // namespace dew

/// Whether dew or hoar is expected on an open dry surface at any row of a series between two
/// instants: whether it would be warmed by 0.3 K or more by condensation if it were level and black
/// and lost heat to the sky by night, between the temperature that it would have alone and the mean
/// of the air, which what lies below has: in the middle with 20 kJ/m²K, near the first for a sheet,
/// near the second for soil or concrete. Uses only the rows, for the estimate of a
/// plan; the solver decides facet by facet (thermal/solve/dew_need).
///
/// Longwave that was not measured: Brutsaert (1975), clouds by 1 + 0.22 n² (Sugita & Brutsaert
/// 1993).
inline bool dew_expected(const ThermalSurface& surface, const Weather& weather, const Site& site,
                         Instant from, Instant to) {
    const double heat = dew::stored(surface.layers);
    const double made_up = heat / (heat + dew::half_made_up);
    const auto within = [&](std::size_t i) {
        return weather.instant[i] >= from && weather.instant[i] <= to;
    };
    double sum = 0.0, rows = 0.0;
    for (std::size_t i = 0; i < weather.instant.size(); ++i) {
        if (!within(i)) continue;
        sum += weather.sample[i].air.temperature;
        rows += 1.0;
    }
    for (std::size_t i = 0; i < weather.instant.size(); ++i) {
        const Instant when = weather.instant[i];
        if (!within(i) || dew::warming(weather.sample[i], made_up, sum / rows) < dew::worth)
            continue;
        if (sun_position(site, when).elevation_deg < 0.0) return true;
    }
    return false;
}

}  // namespace diurna
