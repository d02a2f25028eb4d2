#pragma once

#include "materials/radiation/spectrum.hpp"

namespace diurna {

/// Broadband means of a spectrum: by the solar spectrum at the ground, and by Planck's law at
/// `temperature` [K].
double solar_mean(const Spectrum& s);
double planck_mean(const Spectrum& s, double temperature = 300.0);
/// Share of the ground-level solar spectrum between two wavelengths [µm].
double solar_share(double from_um, double to_um);

}  // namespace diurna
