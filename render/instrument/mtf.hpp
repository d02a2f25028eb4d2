#pragma once

/// Modulation transfer functions in closed form, over spatial frequency f [1/m] in the picture's
/// plane; 1 at f = 0. After Boreman, "Modulation Transfer Function in Optical and Electro-Optical
/// Systems" (2001), and Holst, "Electro-Optical Imaging System Performance" (2008), unless said.
namespace diurna {

/// sin(πx)/(πx): of a square detector or of even motion, x = f · width.
double sinc(double x);

/// A round lens free of errors: (2/π)(acos ν − ν √(1 − ν²)), ν = f λ F, 0 from ν = 1 on.
double diffraction_mtf(double nu);

/// The same with `waves` of defocus at the pupil's edge (W20/λ): Hopkins' autocorrelation of the
/// pupil (1955), (4/π) ∫ √(1 − (x + ν)²) cos(8π W20 ν x) dx from 0 to 1 − ν, to 1e-6. May be
/// negative: contrast reversed. W20 = δ / (8 F²) of a detector δ away from the focus.
double defocused_mtf(double nu, double waves);

/// Shannon's factor of small errors of the wavefront, `rms` in waves to 0.18:
/// 1 − (rms/0.18)² (1 − 4(ν − ½)²). Beyond, 0 at the least.
double wavefront_mtf(double nu, double rms);

/// Charge that spreads by exp(−|x|/length) in a line's picture: 1/(1 + (2π f length)²).
double diffusion_mtf(double frequency, double length);

/// Gaussian motion about the mean, `rms` in the picture's plane: exp(−2π² rms² f²).
double jitter_mtf(double frequency, double rms);

/// Long exposures through turbulence, Fried (1966): exp(−3.44 (λ f_angle / r0)^(5/3)), f_angle in
/// cycles per radian.
double turbulence_mtf(double cycles_per_rad, double wavelength, double fried_length);

/// r0 [m] of a spherical wave over even turbulence: (0.423 · 3/8 k² Cn² R)^(−3/5).
double fried_length(double wavelength, double cn2, double range);

}  // namespace diurna
