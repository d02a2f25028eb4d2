#pragma once

#include <string>
#include <vector>

#include "materials/matter/material.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

/// Notes for the report on a material whose spectra do not cover the wavelengths used, one line
/// each: an albedo or emissivity that is a guess, a band that extends beyond the spectra or beyond
/// the table of n and k.
std::vector<std::string> spectrum_notes(const Material& material, const std::vector<Band>& bands);

}  // namespace diurna
