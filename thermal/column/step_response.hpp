#pragma once

#include <span>
#include <vector>

#include "materials/matter/material.hpp"

namespace diurna {

/// [K per W m⁻²] Temperature of a surface at some times after a constant flux onto it began, from
/// rest, with a linear film to surroundings of constant temperature. Layers with their constants
/// (laws of temperature are ignored), a big leaf as a skin without heat; the bottom as the material
/// has it. Within 2 % of closed forms (half-space: (1 − e^x² erfc x)/h, x = h √t / √(kρc), Carslaw
/// & Jaeger 1959, 2.7; plate of one temperature: (1 − e^−ht/C)/h). A surface without layers
/// responds at once.
///
/// - film: [W m⁻² K⁻¹] above 0, air and radiation
/// - seconds: ascending, above 0
std::vector<double> step_response(const ThermalSurface& surface, double film,
                                  std::span<const double> seconds);

}  // namespace diurna
