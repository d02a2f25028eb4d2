#pragma once

#include <vector>

#include "render/detection/imager.hpp"

namespace diurna {

/// Threshold contrasts of sine waves on the display, over even steps of frequency [cycles/mrad in
/// the scene]: entry i is that of the middle of step i.
struct SystemThreshold {
    double step = 0.0;
    std::vector<double> right, down;
};

/// The eye's threshold through an imager, its display and its noise (Vollmerhausen & Jacobs 2004,
/// eq. 10; Vollmerhausen, Opt. Express 17, 17253, 2009):
///
///     CTF(f/M)/H(f) √(1 + α² S Q_along(f) Q_across / scene_contrast²)
///
/// M magnification; H the imager's MTF times the display's (a square for each pixel); S the density
/// of the noise NETD² δ² / F [K² mrad² s]; Q = ∫ [channel · display · eye]² df over frequencies of
/// both signs, with the channel of noise_channel() along the wave and none across; α = 169.6 √Hz
/// (Vollmerhausen & Jacobs 2004). Up to Imager::finest().
SystemThreshold system_threshold(const Imager& imager, const Viewing& viewing, int steps = 256);

inline constexpr double noise_sensitivity = 169.6;  // α [√Hz]

/// ∫ √(C/CTF) df over the frequencies at which C > CTF, geometric mean of both directions
/// [cycles/mrad].
double task_integral(double contrast, const SystemThreshold& threshold);

/// The metric V = √A/R ∫ √(C/CTF) df, C = ΔT/(2 scene_contrast) at the eye (at most 1, the
/// display's limit).
///
/// - difference: [K] root sum square at the aperture
/// - size: √A [m]
double task_metric(double difference, double size, double range, const SystemThreshold& threshold,
                   const Viewing& viewing);

}  // namespace diurna
