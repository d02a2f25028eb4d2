#pragma once

/// Modulation transfer functions in closed form, over spatial frequency f [1/m] in the focal plane;
/// 1 at f = 0. After Boreman, "Modulation Transfer Function in Optical and Electro-Optical Systems"
/// (2001), and Holst, "Electro-Optical Imaging System Performance" (2008), unless stated.
namespace diurna {

/// sin(πx)/(πx): for a square detector or uniform motion, x = f · width.
double sinc(double x);

/// An aberration-free round lens: (2/π)(acos ν − ν √(1 − ν²)), ν = f λ F, 0 from ν = 1 on.
double diffraction_mtf(double nu);

/// The same with `waves` of defocus at the pupil's edge (W20/λ): Hopkins' autocorrelation of the
/// pupil (1955), (4/π) ∫ √(1 − (x + ν)²) cos(8π W20 ν x) dx from 0 to 1 − ν, to 1e-6. May be
/// negative: reversed contrast. W20 = δ / (8 F²) for a detector δ out of focus.
double defocused_mtf(double nu, double waves);

/// Shannon's factor for small wavefront errors, `rms` in waves up to 0.18: 1 − (rms/0.18)² (1 − 4(ν
/// − ½)²). For larger errors, at least 0.
double wavefront_mtf(double nu, double rms);

/// Charge diffusion with a line spread of exp(−|x|/length): 1/(1 + (2π f length)²).
double diffusion_mtf(double frequency, double length);

/// Gaussian motion about the mean, `rms` in the focal plane: exp(−2π² rms² f²).
double jitter_mtf(double frequency, double rms);

/// Long exposures through turbulence, Fried (1966): exp(−3.44 (λ f_angle / r0)^(5/3)), f_angle in
/// cycles per radian.
double turbulence_mtf(double cycles_per_rad, double wavelength, double fried_length);

/// r0 [m] of a spherical wave in uniform turbulence: (0.423 · 3/8 k² Cn² R)^(−3/5).
double fried_length(double wavelength, double cn2, double range);

}  // namespace diurna
