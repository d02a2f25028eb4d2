#include "materials/matter/material.hpp"

#include <algorithm>

namespace diurna {

double Material::emissivity(double wavelength_um) const {
    return std::clamp(1.0 - reflectance.at(wavelength_um) - transmittance.at(wavelength_um), 0.0,
                      1.0);
}

}  // namespace diurna
