#pragma once

#include "materials/matter/material.hpp"

namespace diurna {

/// A material made darker or brighter in sunlight: its reflectance below 3 µm moved towards black
/// or towards all that it does not transmit, everywhere by the same share, so that its mean under
/// the sun at the ground is `albedo`; from 3.5 µm on, in heat, it stays as it is, and runs straight
/// between. An albedo that the share cannot reach (0 leaves what lies beyond 3 µm) is kept to the
/// heat balance. albedo: 0 to 1 less the solar transmittance.
Material with_albedo(Material material, double albedo);

/// The same from 3.5 µm on: its mean under Planck's law at 300 K is `emissivity`, and what it
/// reflects of sunlight below 3 µm stays. emissivity: 0 to 1 less the transmittance.
Material with_emissivity(Material material, double emissivity);

}  // namespace diurna
