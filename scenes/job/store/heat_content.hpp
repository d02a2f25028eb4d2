#pragma once

#include <string>

#include "scenes/job/plan/prepared.hpp"

namespace diurna {

/// Digest of the numbers from which a scene's temperatures are computed: triangles and what light
/// they let pass, the thermal surface of each facet, targets' networks, air, wind, rain and the
/// resolved sky at every step, the span, its steps and its start. Two scenes of the same digest
/// have the same temperatures, whatever their files say: a visibility counts only where the light
/// is computed from it, a name, a spectrum or a camera never.
///
/// Not included: what selects facets and instants (pictures, tolerance_K), and moving objects.
std::string heat_content(const Prepared& prepared);

}  // namespace diurna
