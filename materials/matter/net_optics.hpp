#pragma once

#include "materials/matter/material.hpp"

namespace diurna {

/// A net: strips of a material over a share of it (Material::cover), the rest open. What it sends
/// back and lets through are cover ρ and 1 − cover + cover τ of its strips. The heat balance stays
/// that of the strips: a net is less of them, and mass, air, sun and longwave go by their area
/// alike.

/// Makes a net of strips.
void open_up(double cover, Material& strips);

/// The spectra of a net's strips in place of the net's, or of what is none as they are: the inverse
/// of open_up(). Of a net that covers nothing nobody knows them; they stay what they are.
void take_strips(Material& net);

}  // namespace diurna
