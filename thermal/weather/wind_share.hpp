#pragma once

namespace diurna {

// Share of a station's measured wind at a low or sheltered place.

inline constexpr double open_roughness = 0.03;  // [m] of a station's surroundings: open, short
                                                // grass (Davenport's class 3; Wieringa 1992)

/// Ratio of the wind at a height to that at another, by the logarithmic profile of open ground,
/// ln(z / z₀) / ln(z_r / z₀): 0.67 at 1.5 m of that at 10 m. Below 0.5 m the value at 0.5 m.
///
/// height, reference  [m] above the ground
double wind_at_height(double height, double reference);

/// Reduction of the wind in the lee of a wall across it, 0 to 1 (Perera 1981, J. Wind Eng. Ind.
/// Aerodyn. 8, 93; as in the European Wind Atlas, 1989):
///
///     9.75 (h/x) η exp(−0.67 η^1.5),   η = (z/h) (K x/h)^−0.47,   K = 2 κ² / ln(h / z₀)
///
/// 0.47 at the wall's height ten heights behind it. At most two thirds, next to it, where air flows
/// back at a third of the wind's speed (Castro & Robins 1977); zero from 30 heights on.
///
/// distance  [m] behind it, x
/// obstacle  [m] its height, h
/// height    [m] of the point, z; below 2 m the value at 2 m
double lee_deficit(double distance, double obstacle, double height);
inline constexpr double lee_reach = 30.0;  // [heights]

}  // namespace diurna
