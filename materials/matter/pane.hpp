#pragma once

#include <complex>

namespace diurna {

/// What a sheet with two smooth, parallel faces does to unpolarised light, thicker than light keeps
/// its phase: with F of a face and a its inside on one way,
///
///     T = (1 − F)² a / (1 − F² a²),   R = F + F a T                     each polarisation by
///     itself
///
/// (Stokes 1862; Born & Wolf 7.6 without interference).
struct PaneOptics {
    double reflectance, transmittance;
};
/// - cosine: of the angle of incidence, 0 to 1
/// - inside: what is left of light that crosses it upright, 0 to 1; at an angle its power by the
///   longer way
PaneOptics pane_optics(double cosine, std::complex<double> index, double inside);

/// The inside of a pane that lets this through upright: the root of the formula above.
double inside_of_pane(double transmittance, std::complex<double> index);

}  // namespace diurna
