#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "materials/atmosphere/medium.hpp"

namespace diurna {

/// Scattering of sunlight by air, per kilometre and bin.
struct Scatterers {
    std::vector<double> rayleigh;            // (bin) [km⁻¹]
    std::vector<double> aerosol_extinction;  // (bin) [km⁻¹], rain included
    std::vector<double> aerosol_scattering;  // (bin) [km⁻¹]
    std::vector<double> asymmetry;           // (bin) of the aerosol
    /// Scattering [km⁻¹] of boundary-layer aerosol, tropospheric aerosol and rain: (bin), or empty.
    std::array<std::vector<double>, 3> part;
};

Scatterers scatterers(const Medium& medium, double height_km);

/// Henyey and Greenstein's phase function of mean cosine g, mean 1 over the sphere.
inline double henyey_greenstein(double g, double cosine) {
    const double d = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (d * std::sqrt(d));
}

/// Phase function of each part of the scatterers at an angle, (bin).
std::array<std::vector<double>, 3> phase_functions(const Medium& medium, double cosine);

}  // namespace diurna
