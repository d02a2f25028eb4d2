#pragma once

#include "render/detection/imager.hpp"

namespace diurna {

/// Minimum resolvable temperature difference [K] of four bars seven times as long as wide, at a
/// frequency [cycles/mrad] to the right: the eye integrates the noise over a bar's area and over
/// its time t, and sees the bar if the signal-to-noise ratio exceeds SNR (Lloyd, "Thermal Imaging
/// Systems", 1975, 5.4; Ratches and others, ECOM-7043, 1975):
///
///     MRT(f) = SNR π²/(4 √7) · NETD f δ / (MTF(f) √(t F))
///
/// δ pixel, F frames a second, noise independent between pixels and frames. SNR = 2.25, t = 0.2 s
/// (Ratches and others 1975). 8/π² is a bar's mean of the fundamental over its width. Infinite if
/// the modulation is zero.
double resolvable_difference(double cycles_per_mrad, double mtf, const Imager& imager);

inline constexpr double bar_threshold = 2.25;  // signal to noise
inline constexpr double eye_seconds = 0.2;

/// Finest bars seen at a difference [K]: √(right · down) [cycles/mrad] as in FLIR92 (Scott &
/// D'Agostino, Proc. SPIE 1689, 1992), each to 1e-9 of Imager::finest(), which is the
/// maximum.
double resolved_frequency(double difference, const Imager& imager);

/// Cycles over a length [m] at a range [m].
double resolved_cycles(double difference, double length, double range, const Imager& imager);

}  // namespace diurna
