#pragma once

#include <string>
#include <vector>

#include "materials/matter/material.hpp"
#include "materials/radiation/band.hpp"

namespace diurna {

/// What a reader should know of a material whose spectra end short of what they are used for, a
/// line each: an albedo or emissivity that is a guess, a band that reaches past their ends
/// or past those of the table of n and k.
std::vector<std::string> spectrum_notes(const Material& material, const std::vector<Band>& bands);

}  // namespace diurna
