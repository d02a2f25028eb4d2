#pragma once

#include "materials/atmosphere/band_model.hpp"

namespace diurna {

/// Vertical optical depth of the model's aerosol at a wavelength, from its ground up, for broadband
/// formulas that need a depth instead of a visibility. Without rain and clouds.
///
/// wavelength_um  0.36 to 2
///
/// Rural aerosol of 23 km has 0.325 at 0.55 µm (LOWTRAN, MODTRAN and SMARTS for summer; 6S, whose
/// profile is shallower, 0.235): tests/materials/haze_column_test.cpp.
double aerosol_depth(const BandModel& model, double wavelength_um);

}  // namespace diurna
