#pragma once

#include <vector>

#include "materials/atmosphere/scatterers.hpp"

namespace diurna {

/// The aerosol with the forward peak of its scattering counted as unscattered (delta scaling: the
/// share g²; Joseph, Wiscombe & Weinman 1976).
struct ScaledAerosol {
    std::vector<double> extinction;  // (bin) [km⁻¹] of aerosol
    std::vector<double> scattering;  // (bin) [km⁻¹] of aerosol
    std::vector<double> asymmetry;   // (bin)
    Scatterers whole;

    /// Extinction [km⁻¹] removed by the scaling.
    double peak(std::size_t bin) const { return whole.aerosol_extinction[bin] - extinction[bin]; }
};
ScaledAerosol scaled_aerosol(const Medium& medium, double height_km);

}  // namespace diurna
