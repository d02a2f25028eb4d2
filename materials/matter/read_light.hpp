#pragma once

#include <filesystem>

#include "materials/base/section.hpp"
#include "materials/matter/material.hpp"

namespace diurna {

/// All optical keys of a material: spectra and their means (materials/matter/read_optics.hpp), the
/// angular law (materials/matter/read_finish.hpp), and
///
/// - see_through: true if rays continue behind it, attenuated by its transmittance
/// - cover: 0 to 1, of a net: this share is the material and the rest is open
///
/// A material derived from another that has none of these keys stays bitwise unchanged; the other
/// keys of a net are those of its strips.
///
/// fresh  the material starts from no other material
void read_light(const Section& section, bool fresh, Material& material);

}  // namespace diurna
