#pragma once

#include "materials/matter/material.hpp"

namespace diurna {

/// A material made darker or brighter in sunlight: its reflectance below 3 µm is moved towards zero
/// or towards 1 − transmittance, by the same share at every wavelength, so that its mean under the
/// sun at the ground is `albedo`; from 3.5 µm on, in the thermal range, it is unchanged, with
/// linear interpolation between. An albedo that no share can give (0, because of the part beyond 3
/// µm) is used in the heat balance only. albedo: 0 to 1 less the solar transmittance.
Material with_albedo(Material material, double albedo);

/// The same from 3.5 µm on: its mean under Planck's law at 300 K is `emissivity`; its reflectance
/// of sunlight below 3 µm is unchanged. emissivity: 0 to 1 less the transmittance.
Material with_emissivity(Material material, double emissivity);

}  // namespace diurna
