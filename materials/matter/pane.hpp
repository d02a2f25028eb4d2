#pragma once

#include <complex>

namespace diurna {

/// Reflectance and transmittance, for unpolarised light, of a sheet with two smooth, parallel faces
/// that is too thick for interference: with F of a face and a of its interior on one pass,
///
///     T = (1 − F)² a / (1 − F² a²),   R = F + F a T
///                                                          (each polarisation separately)
///
/// (Stokes 1862; Born & Wolf 7.6 without interference).
struct PaneOptics {
    double reflectance, transmittance;
};
/// - cosine: of the angle of incidence, 0 to 1
/// - inside: transmittance of the interior at normal incidence, 0 to 1; at an angle, raised to the
///   power of the longer path
PaneOptics pane_optics(double cosine, std::complex<double> index, double inside);

/// The interior of a pane with this transmittance at normal incidence: root of the formula above.
double inside_of_pane(double transmittance, std::complex<double> index);

}  // namespace diurna
