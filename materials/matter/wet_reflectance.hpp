#pragma once

#include "materials/radiation/spectrum.hpp"

namespace diurna {

/// Reflectance of a rough, absorbing, porous surface (soil, stone, brick, concrete, asphalt) under
/// a film of water: light enters the film, is scattered by the surface below, and is partly
/// reflected back by the film's underside (Ångström 1925; Lekner & Dorf 1988, Appl. Opt. 27, 1278),
///
///     1 − ρ_wet = (1 − R) (1 − ρ') / (1 − p ρ'),   p = 1 − (1 − R_diffuse) / n²
///
/// where R is that of water along the normal, R_diffuse = 0.066 that for diffuse light, ρ' that of
/// the dry surface after 20 µm of water down and up, slanting (this makes wet ground dark beyond
/// 1.4 µm and nearly black in the thermal range). The library's wet soils are made this way
/// (materials/spectra/wet_soil.csv). Not included: grains scatter less sharply in water (Twomey et
/// al. 1986, Appl. Opt. 25, 431); measured soils become darker still (Idso et al. 1975, J. Appl.
/// Meteorol. 14, 109: from 0.30 to 0.14, where this gives 0.21).
Spectrum wet_reflectance(const Spectrum& dry);

/// ρ_wet without the film's absorption, for a dry reflectance and an index of refraction.
double wet_reflectance(double dry, double index);

}  // namespace diurna
