#pragma once

#include <span>

#include "materials/radiation/band.hpp"

namespace diurna {

/// Spectral radiance of a black body, B(λ, T) = c1 λ⁻⁵ / (exp(c2 / λT) − 1).
///
/// wavelength_um  [µm]               0.2 to 100
/// temperature    [K]                positive
/// returns        [W m⁻² sr⁻¹ µm⁻¹]  zero where the exponential overflows (cold and short)
///
/// Relative error below 1e-12 over 0.35 to 20 µm, 180 to 6000 K (tests/materials/planck_test.cpp).
/// Source: CODATA 2018 constants.
double planck(double wavelength_um, double temperature);

/// The temperature [K] whose black body has the spectral radiance: the inverse of planck(), for a
/// radiance above zero.
double planck_temperature(double wavelength_um, double radiance);

/// ∂B/∂T [W m⁻² sr⁻¹ µm⁻¹ K⁻¹]; finite everywhere, zero where B underflows.
double planck_derivative(double wavelength_um, double temperature);

/// ∫ response(λ) B(λ, T) dλ [W m⁻² sr⁻¹] by the band's quadrature, and its derivative by T.
double band_radiance(const Band& band, double temperature);
double band_radiance_derivative(const Band& band, double temperature);

/// The temperature [K] of the black body whose band radiance is `radiance`: the inverse of
/// `band_radiance`, by bracketed Newton, to 1e-9 K. 0 K for a radiance of zero or less.
double brightness_temperature(const Band& band, double radiance);

}  // namespace diurna
