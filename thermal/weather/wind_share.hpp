#pragma once

namespace diurna {

// How much of the wind that a station measures reaches something low, or in the lee.

inline constexpr double open_roughness = 0.03;  // [m] of a station's surroundings: open, short
                                                // grass (Davenport's class 3; Wieringa 1992)

/// The wind at a height over that at another, by the logarithmic profile of open ground,
/// ln(z / z₀) / ln(z_r / z₀): 0.67 at 1.5 m of that at 10 m. Below 0.5 m as there.
///
/// height, reference  [m] above the ground
double wind_at_height(double height, double reference);

/// What a wall across the wind takes off it in its lee, 0 to 1 (Perera 1981, J. Wind Eng. Ind.
/// Aerodyn. 8, 93; as in the European Wind Atlas, 1989):
///
///     9.75 (h/x) η exp(−0.67 η^1.5),   η = (z/h) (K x/h)^−0.47,   K = 2 κ² / ln(h / z₀)
///
/// 0.47 at its own height ten heights behind. Two thirds at the most, next to it, where air turns
/// back at a third of the wind's speed (Castro & Robins 1977); nought from 30 heights on.
///
/// distance  [m] behind it, x
/// obstacle  [m] its height, h
/// height    [m] where the wind is asked for, z; below 2 m as there
double lee_deficit(double distance, double obstacle, double height);
inline constexpr double lee_reach = 30.0;  // [heights]

}  // namespace diurna
