#pragma once

#include <filesystem>

#include "materials/base/section.hpp"
#include "materials/matter/material.hpp"

namespace diurna {

/// All keys of a material that say what it does with light: spectra and their means
/// (materials/matter/read_optics.hpp), the law of angle (materials/matter/read_finish.hpp), and
///
/// - see_through: true where rays go on behind it, as far as its transmittance lets them
/// - cover: 0 to 1, of a net: this share is the material and the rest is open
///
/// What is like another and says nothing of them stays that, to the last digit; of a net the other
/// keys are those of its strips.
///
/// fresh  the material starts from no other
void read_light(const Section& section, bool fresh, Material& material);

}  // namespace diurna
