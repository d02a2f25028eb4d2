#pragma once

#include "materials/matter/material.hpp"

namespace diurna {

/// A net: strips of a material over a share of it (Material::cover), the rest open. Its
/// reflectance is cover ρ and its transmittance 1 − cover + cover τ of its strips. The heat
/// balance is that of the strips: mass and exchange with air, sun and longwave are all
/// proportional to their area.

/// Changes a strip material into a net.
void open_up(double cover, Material& strips);

/// Replaces a net's spectra by those of its strips: the inverse of open_up(). Other materials are
/// unchanged, and so is a net with zero cover, whose strips' spectra are unknown.
void take_strips(Material& net);

}  // namespace diurna
