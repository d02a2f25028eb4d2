#pragma once

#include "materials/radiation/spectrum.hpp"

namespace diurna {

/// Reflectance of a rough, absorbing, porous surface (soil, stone, brick, concrete, asphalt) under
/// a film of water: light enters the film, is scattered by what is below, and in part kept in by
/// the film's underside (Ångström 1925; Lekner & Dorf 1988, Appl. Opt. 27, 1278),
///
///     1 − ρ_wet = (1 − R) (1 − ρ') / (1 − p ρ'),   p = 1 − (1 − R_diffuse) / n²
///
/// R of water's face along the normal, R_diffuse = 0.066 of diffuse light, ρ' the dry surface's
/// after 20 µm of water down and up, slanting (it is what makes wet ground dark beyond 1.4 µm and
/// nearly black in heat). The library's wet soils are made so (materials/spectra/wet_soil.csv).
/// That grains scatter less sharply in water (Twomey et al. 1986, Appl. Opt. 25, 431) is skipped:
/// soils measured become darker still (Idso et al. 1975, J. Appl. Meteorol. 14, 109: from 0.30 to
/// 0.14, where this gives 0.21).
Spectrum wet_reflectance(const Spectrum& dry);

/// ρ_wet without the film's absorption: of what scatters `dry`, by the index of refraction.
double wet_reflectance(double dry, double index);

}  // namespace diurna
