#pragma once

/// The eye of an observer of a display. Frequencies are in cycles per milliradian at the eye,
/// luminances in cd/m².
namespace diurna {

/// Contrast of a sine wave that is seen half the time, (Lmax − Lmin)/(Lmax + Lmin): 1/(a u
/// e^(−b u) √(1 + 0.06 e^(b u))), u in cycles per degree, a = 540 (1 + 0.7/L)^−0.2 / (1 +
/// 12/(w (1 + u/3)²)), b = 0.3 (1 + 100/L)^0.15 (Barten, "Evaluation of subjective image
/// quality with the square-root integral method", J. Opt. Soc. Am. A 7, 2024, 1990; the
/// naked eye of NVThermIP, Vollmerhausen & Jacobs, AMSEL-NV-TR-230, 2004). The originals
/// were not available: w, in degrees, is not squared as in two public implementations, and
/// as for a small field in Barten's formula of 2003, (1 + 144/w²)^−½. Above 1 nothing is
/// seen.
///
/// - size_deg: w, square root of the display's angular area
double contrast_threshold(double cycles_per_mrad, double luminance, double size_deg);

/// Diameter of the pupil [mm] by a table over the logarithm of luminance, 7.0 at 1e-4 to 2.5 at
/// 1000 foot-lamberts (Overington, "Vision and Acquisition", 1976, as used in NVThermIP).
double pupil_diameter_mm(double luminance);

/// Transfer function of lens, retina and tremor of the eye, exp(−(f/f0)^i0) exp(−0.375 f^1.21)
/// exp(−0.4441 f²), f in cycles/mrad; f0 and i0 by a table over the pupil's diameter, 36 and 0.9 at
/// 1.5 mm to 8 and 0.66 at 6.6 mm (Overington 1976, as used in NVThermIP).
double eye_mtf(double cycles_per_mrad, double pupil_mm);

/// Weight of noise of frequency `noise` for detecting `signal`: exp(−2.2 ln²(noise/signal)), of the
/// amplitude (Barten, "Contrast Sensitivity of the Human Eye", 1999, chapter 2).
double noise_channel(double noise, double signal);

}  // namespace diurna
