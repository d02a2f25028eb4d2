#pragma once

#include <string>

#include "materials/matter/library.hpp"

namespace diurna {

/// materials/library.svg: a row for each material with its colour in daylight, reflectance and
/// transmittance over 0.3 to 20 µm, bars of albedo and of emissivity in 3-5 and 8-12 µm,
/// diffusivity and inertia of the top layer.
std::string swatch_chart(const MaterialLibrary& library);

}  // namespace diurna
